#include "sdf/load_sdf.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "sdf/evaluate.h"
#include "sdf/load_tree.h"
#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

using Json = nlohmann::json;

std::string refusal(const std::string& text) {
    try {
        loadSdf(text);
    } catch (const SceneError& error) {
        return error.what();
    }
    return "taken";
}

std::string withTree(const std::string& tree) {
    return R"({"tree": )" + tree + "}";
}

double valueOf(const std::string& tree, const glm::dvec3& p) {
    return valueAt(lower(loadSdf(withTree(tree)).tree), p);
}

TEST(LoadSdf, EveryRefusalNamesThePathAndTheRule) {
    const Json cases = Json::parse(std::ifstream(EDGEWISE_SDF_TESTS "/refused_scenes.json"));
    ASSERT_GT(cases.size(), 40u);
    for (const Json& one : cases) {
        try {
            loadSdf(one["scene"].dump());
            ADD_FAILURE() << "taken: " << one;
        } catch (const SceneError& error) {
            EXPECT_EQ(error.element, one["path"]) << error.what();
            EXPECT_NE(error.rule.find(one["rule"]), std::string::npos) << error.rule << "\n" << one["rule"];
        }
    }
}

TEST(LoadSdf, WhatASchemaCannotSayIsRefusedToo) {
    const std::string sphere = R"("tree": {"type": "sphere", "radius": 1)";
    EXPECT_EQ(refusal("{" + sphere + R"(, "material": "bras"}, "materials": {"brass": {}}})"),
              "tree.material: no material is called 'bras'; did you mean 'brass'?");
    EXPECT_EQ(refusal("{" + sphere + R"(}, "materials": [{"name": "a"}, {"name": "a"}]})"),
              "materials[1].name: 'a' is there twice");
    EXPECT_EQ(refusal("{" + sphere + R"(}, "materials": {"a": {"reflectance": 0.7, "transmittance": 0.5}}})"),
              "materials.a: reflectance and transmittance must not exceed 1 together, not 1.2");
    EXPECT_EQ(refusal("{" + sphere + R"(}, "cameras": [{"eye": [1, 2, 3], "target": [1, 2, 3]}]})"),
              "cameras[0]: eye and target must be apart");
    EXPECT_EQ(refusal("{" + sphere + R"(}, "cameras": [{"eye": [0, 2, 0], "target": [0, 0, 0]}]})"),
              "cameras[0].up: must not point along the view");
    EXPECT_EQ(refusal(withTree(R"({"type": "twist", "degrees_per_unit": 9,
                                   "child": {"type": "plane", "normal": [1, 1, 0]}})")),
              "tree.radius: must be given: the child has no bounds across the y axis");
    EXPECT_EQ(refusal(withTree(R"({"type": "repeat", "spacing": [1, 0, 0], "count": [2, 0, 0],
                                   "child": {"type": "sphere", "radius": 0.6}})")),
              "tree: repeats a child that reaches beyond half the spacing");
    EXPECT_EQ(refusal(withTree(R"({"type": "repeat", "spacing": [1, 0, 0], "count": [2, 0, 0],
                                   "child": {"type": "box", "size": [0.5, 1, 1], "at": [0.25, 0, 0]}})")),
              "tree: repeats a child that fills its cells and is not its own mirror image");
}

TEST(LoadSdf, TextThatIsNoJsonIsPlacedByLineAndColumn) {
    EXPECT_EQ(refusal("").substr(0, 16), "line 1, column 1");
    EXPECT_EQ(refusal("{\n  \"tree\": {,\n}").substr(0, 18), "line 2, column 12:");
    EXPECT_EQ(refusal("{\"a\": 1,\n \"a\": 2}"), "line 2, column 4: the key 'a' is there twice");
    EXPECT_EQ(refusal("{\"far\": 1e999}").substr(0, 7), "line 1,");
    EXPECT_NE(refusal("{\"far\": 1e999}").find("overflow"), std::string::npos);
    EXPECT_EQ(refusal("{\"far\": NaN}").substr(0, 7), "line 1,");
    EXPECT_EQ(refusal("{} {}").substr(0, 7), "line 1,");
    EXPECT_EQ(refusal("{\"a\": \"" + std::string(100000, 'x')).substr(0, 7), "line 1,");
    EXPECT_LT(refusal("{\"a\": \"" + std::string(100000, 'x')).size(), 400u);
}

TEST(LoadSdf, DepthEndsInAMessage) {
    EXPECT_EQ(refusal(std::string(100000, '[')),
              "line 1, column 601: arrays and objects nest at most 600 deep");
    EXPECT_NE(refusal(std::string(100000, '{')), "taken");
    const auto nested = [](int depth, const std::string& type) {
        std::string text;
        for (int i = 1; i < depth; ++i) text += R"({"type": ")" + type + R"(", "child": )";
        return withTree(text + R"({"type": "sphere", "radius": 1})" + std::string(depth - 1, '}'));
    };
    EXPECT_EQ(refusal(nested(kMostTreeLevels, "complement")), "taken");
    EXPECT_NE(refusal(nested(kMostTreeLevels + 1, "complement")).find("nodes nest at most 256 deep"),
              std::string::npos);
    // Each asks for its child's box: were it asked twice a level, 2^40 boxes would be.
    std::string text;
    for (int i = 0; i < 40; ++i) text += R"({"type": "twist", "degrees_per_unit": 1e-6, "child": )";
    EXPECT_EQ(refusal(withTree(text + R"({"type": "sphere", "radius": 1})" + std::string(40, '}'))), "taken");
    EXPECT_NE(refusal(withTree([] {
                  std::string steep;
                  for (int i = 0; i < 100; ++i) steep += R"({"type": "scale", "factor": 1e-6, "child": )";
                  return steep + R"({"type": "sphere", "radius": 1})" + std::string(100, '}');
              }()))
                  .find("as fast as position does"),
              std::string::npos);
}

TEST(LoadSdf, PlacesFirstScaleThenTurnThenMove) {
    // A box 2 long in x, doubled, turned to lie along y, moved to y = 10: its ends are at y = 8 and 12.
    const std::string tree = R"({"type": "box", "size": [2, 0.5, 0.5], "at": [0, 10, 0], "scale": 2,
                                 "rotate": {"axis": [0, 0, 1], "degrees": 90}})";
    EXPECT_NEAR(valueOf(tree, {0, 13, 0}), 1.0, 1e-14);
    EXPECT_NEAR(valueOf(tree, {0, 7, 0}), 1.0, 1e-14);
    EXPECT_NEAR(valueOf(tree, {1.5, 10, 0}), 1.0, 1e-14);
}

TEST(LoadSdf, RaysReachWhatACameraFrames) {
    const auto farOf = [](const std::string& rest) { return loadSdf("{" + rest + "}").far; };
    const std::string small = R"("tree": {"type": "sphere", "radius": 1})",
                      large = R"("tree": {"type": "sphere", "radius": 500})";
    EXPECT_EQ(farOf(small), 1000.0);
    EXPECT_EQ(farOf(R"("far": 20, )" + large), 20.0);
    // The framing camera is 1.05 / sin(half its angle) radii of the bounds' ball away.
    EXPECT_GT(farOf(large), (1.05 / std::sin(5.0 * 3.14159265 / 180.0) + 1.0) * 500.0 * std::sqrt(3.0));
    const FieldScene endless = loadSdf(
        R"({"tree": {"type": "repeat", "spacing": [4, 4, 0], "child": {"type": "sphere", "radius": 1}}})");
    EXPECT_EQ(endless.bounds.high[0], 13.0);
    EXPECT_EQ(endless.bounds.high[2], 1.0);
}

/// In time that grows with the depth, not with 2 to its power.
TEST(LoadSdf, RepetitionsMayNest) {
    std::string tree = R"({"type": "sphere", "radius": 1})";
    for (int i = 0; i < 60; ++i) tree = R"({"type": "repeat", "spacing": [0, 0, 0], "child": )" + tree + "}";
    EXPECT_NEAR(valueOf(tree, {3, 0, 0}), 2.0, 1e-14);
}

TEST(LoadSdf, ReadsWhatIsBesideTheTree) {
    const FieldScene scene = loadSdf(R"({"$schema": "x", "title": "t", "far": 50, "ambient": [0.1, 0.2, 0.3],
        "background": [1, 2, 3], "reflections": 4, "refractions": 0, "path_traced": true,
        "materials": {"b": {"shading": "unlit", "pattern": "stripes", "pattern_axis": [0, 0, 2]}, "a": {"ior": 2}},
        "cameras": [{"name": "c", "eye": [0, 0, 9], "target": [0, 0, 0], "fovy": 30},
                    {"type": "orthographic", "eye": [0, 0, 9], "target": [0, 0, 0], "ymag": 3}],
        "lights": [{"direction": [0, -2, 0], "intensity": 3, "shadows": false},
                   {"type": "point", "position": [1, 2, 3]}],
        "analytic": [{"type": "sphere", "center": [5, 0, 0], "radius": 1, "material": "b"},
                     {"type": "plane", "normal": [0, 3, 0], "offset": -1}],
        "convex": {"center": [0, 0, 0], "radius": 2},
        "tree": {"type": "union", "material": "a", "children": [{"type": "sphere", "radius": 2},
                 {"type": "plane", "normal": [0, 1, 0]}]}})");
    ASSERT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(scene.materials[0].name, "a");
    EXPECT_EQ(scene.materials[0].ior, 2.0);
    EXPECT_EQ(scene.materials[1].shading, SurfaceMaterial::Shading::kUnlit);
    EXPECT_EQ(scene.materials[1].pattern, SurfaceMaterial::Pattern::kStripes);
    EXPECT_EQ(scene.materials[1].pattern_axis, glm::dvec3(0, 0, 1));
    EXPECT_EQ(scene.materials[2].name, "default");
    EXPECT_EQ(scene.far, 50.0);
    EXPECT_EQ(scene.background.value(), glm::dvec3(1, 2, 3));
    EXPECT_TRUE(scene.path_traced);
    EXPECT_EQ(scene.refractions, 0);
    EXPECT_EQ(scene.cameras[0].fovy_degrees, 30.0);
    EXPECT_FALSE(scene.cameras[1].perspective);
    EXPECT_EQ(scene.cameras[1].ymag, 3.0);
    EXPECT_EQ(scene.lights[0].direction_world, glm::dvec3(0, -1, 0));
    EXPECT_FALSE(scene.lights[0].shadows);
    EXPECT_EQ(scene.lights[1].type, SurfaceLight::Type::kPoint);
    EXPECT_EQ(scene.analytic[0].material, 1u);
    EXPECT_EQ(scene.analytic[1].material, 2u);
    EXPECT_EQ(scene.analytic[1].normal_world, glm::dvec3(0, 1, 0));
    EXPECT_EQ(scene.convex->radius, 2.0);
    EXPECT_EQ(lower(scene.tree).instructions[0].material, 0u);
    // The plane has no bounds; the analytic ball reaches to x = 6.
    EXPECT_EQ(scene.bounds.low[0], -2.0);
    EXPECT_EQ(scene.bounds.high[0], 6.0);
    EXPECT_EQ(scene.bounds.high[1], 2.0);
}

}  // namespace
}  // namespace edgewise::sdf
