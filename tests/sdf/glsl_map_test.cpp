#include <gtest/gtest.h>

#include "sdf/load_glsl_map.h"
#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

const std::string kMap = "float map(vec3 p) { return length(p) - 1.0; }\n";

std::string refusal(const std::string& text) {
    try {
        loadGlslMap(text, "a.map.glsl");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "taken";
}

TEST(GlslMap, ReadsItsHeader) {
    const std::string text =
        "// A ball: mine\r\n/* more\n words */\n\n// camera: eye 0 1 -4.5 target 0 0 0 fovy 40\n"
        "//camera: fovy 30 target 0 0 1 eye +9 0 0\n// light: direction 0 -2 0\n// background: 0.1 0.2 0.3\n"
        "// far: 50\n// lipschitz: 1.5\n" +
        kMap + "vec3 albedo(vec3 p, vec3 n) { return n; }\n// far: nonsense below the code\n";
    const FieldScene scene = loadGlslMap(text, "a.map.glsl");
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].eye_world, glm::dvec3(0, 1, -4.5));
    EXPECT_EQ(scene.cameras[0].fovy_degrees, 40.0);
    EXPECT_EQ(scene.cameras[1].eye_world, glm::dvec3(9, 0, 0));
    EXPECT_EQ(scene.lights.at(0).direction_world, glm::dvec3(0, -1, 0));
    EXPECT_EQ(scene.background.value(), glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(scene.far, 50.0);
    EXPECT_EQ(scene.glsl->lipschitz, 1.5);
    EXPECT_TRUE(scene.glsl->has_albedo);
    EXPECT_EQ(scene.glsl->text, text);
    EXPECT_TRUE(scene.tree.empty());
}

TEST(GlslMap, ABoundMayStandBesideItsMap) {
    const FieldScene scene = loadGlslMap(
        "float f(float x) { return x; } /* a\n// lipschitz: 9\n*/\n"
        "// light: the key light\n// lipschitz: 3\n" +
            kMap,
        "a");
    EXPECT_EQ(scene.glsl->lipschitz, 3.0);
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_EQ(refusal("// lipschitz: 2\n" + kMap + "// lipschitz: 3\n"), "line 3: lipschitz: is there twice");
}

TEST(GlslMap, NeedsNoHeader) {
    const FieldScene scene = loadGlslMap("float  map ( vec3 p ) { return p.y; }  // vec3 albedo(", "a");
    EXPECT_FALSE(scene.glsl->has_albedo);
    EXPECT_TRUE(scene.cameras.empty());
}

TEST(GlslMap, HeaderStandsAmongDirectivesAndBlocks) {
    const FieldScene scene = loadGlslMap(
        "\xEF\xBB\xBF#version 300 es\nprecision highp float;\n/* a */ /* b\n c */ // far: 7\r" + kMap, "a");
    EXPECT_EQ(scene.far, 7.0);
    EXPECT_EQ(scene.glsl->text[0], '#');
    EXPECT_EQ(refusal("float" + std::string(1000000, ' ') + "map (vec3 p);"), "taken");
    EXPECT_EQ(refusal("// float \\\nfloat map(vec3 p);"), "the file: defines no function float map(vec3 p)");
    EXPECT_EQ(refusal("afloat map(vec3 p); float mapp(vec3 p); float\nmap;"),
              "the file: defines no function float map(vec3 p)");
}

TEST(GlslMap, RefusesWithTheLine) {
    EXPECT_EQ(refusal("\n// far: x\n" + kMap), "line 2: far: 'x' is not a number from -1000000 to 1000000");
    EXPECT_EQ(refusal("// far: nan\n" + kMap), "line 1: far: 'nan' is not a number from -1000000 to 1000000");
    EXPECT_EQ(refusal("// far: -1\n" + kMap), "line 1: far: must be at least 1e-06, not -1");
    EXPECT_EQ(refusal("// far: 1 2\n" + kMap), "line 1: far: has too much; it takes a number");
    EXPECT_EQ(refusal("// far: 1\n// far: 2\n" + kMap), "line 2: far: is there twice");
    EXPECT_EQ(refusal("// background: 1 2\n" + kMap),
              "line 1: background: ends too early; it takes three numbers");
    EXPECT_EQ(refusal("// background: 1 2 -2\n" + kMap), "line 1: background: must not be negative");
    EXPECT_EQ(refusal("// light: 1 2 3\n" + kMap),
              "line 1: light: '1' is out of place; it takes direction three numbers");
    EXPECT_EQ(refusal("// light: direction 0 0 0\n" + kMap), "line 1: light: direction must not be all 0");
    EXPECT_EQ(
        refusal("// camera: eye 1 2 3\n" + kMap),
        "line 1: camera: lacks something; it takes eye three numbers, target three numbers, [fovy a number]");
    EXPECT_EQ(refusal("// camera: eye 1 2 3 target 1 2 3\n" + kMap), "line 1: eye and target must be apart");
    EXPECT_EQ(refusal("// camera: eye 1 2 3 target 0 0 0 fovy 180\n" + kMap),
              "line 1: camera: fovy must be below 180, not 180");
    EXPECT_EQ(refusal("// camera: eye 0 9 0 target 0 0 0\n" + kMap), "taken");
    EXPECT_EQ(refusal("float mapp(vec3 p);"), "the file: defines no function float map(vec3 p)");
    EXPECT_EQ(refusal("// float map(vec3 p)"), "the file: defines no function float map(vec3 p)");
    EXPECT_EQ(refusal("/* float map(vec3 p)"), "the file: defines no function float map(vec3 p)");
    EXPECT_EQ(refusal(""), "the file: defines no function float map(vec3 p)");
    EXPECT_EQ(refusal(kMap + std::string(1, '\0')), "the file: has a NUL byte");
    EXPECT_EQ(refusal(std::string(kMostMapBytes + 1, ' ')).substr(0, 27), "the file: must have at most");
}

}  // namespace
}  // namespace edgewise::sdf
