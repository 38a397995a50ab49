// Raw GLSL as a mesh, by the device's answers, against the same solids written in C++.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pipeline/error.h"
#include "pipeline/judge/mesh_quality.h"
#include "pipeline/polygonize.h"
#include "pipeline/polygonize_within.h"
#include "sdf/load_glsl_map.h"
#include "tests/pipeline/field_pictures.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan {
namespace {

class MapMesh : public testing::Test {
  protected:
    static Scene sceneOf(const std::string& text) {
        Scene scene;
        scene.source = "a.map.glsl";
        scene.field = std::make_shared<sdf::FieldScene>(sdf::loadGlslMap(text, "a.map.glsl"));
        return scene;
    }
    static Polygonized meshOf(const std::string& text, const PolygonizeOptions& options) {
        return polygonize(sceneOf(text), options);
    }
    static std::string refusal(const std::string& text, const PolygonizeOptions& options) {
        try {
            meshOf(text, options);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    }
};

/// A ball without a box, with the colour of the place.
const std::string kBallMinusBox = R"(
float box(vec3 p, vec3 h) {
    vec3 q = abs(p) - h;
    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}
float map(vec3 p) { return max(length(p) - 1.0, -box(p - vec3(0.55, 0.5, 0.6), vec3(0.65))); }
vec3 albedo(vec3 p, vec3 n) { return clamp(0.5 + 0.5 * p, 0.0, 1.0); }
)";
double ballMinusBox(const glm::dvec3& p) {
    const glm::dvec3 q = glm::abs(p - glm::dvec3(0.55, 0.5, 0.6)) - 0.65;
    return std::max(glm::length(p) - 1.0,
                    -(glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0)));
}

TEST_F(MapMesh, IsWhereTheFieldIs) {
    PolygonizeOptions options;
    options.resolution = 48;
    for (const Mesher mesher : {Mesher::kDual, Mesher::kMarchingCubes}) {
        options.mesher = mesher;
        const Polygonized made = meshOf(kBallMinusBox, options);
        const MeshQuality quality = qualityOf(made.mesh);
        EXPECT_TRUE(quality.closed());
        EXPECT_TRUE(quality.manifold());
        EXPECT_EQ(quality.euler, 2);
        EXPECT_TRUE(made.notes.empty());
        double farthest = 0.0;
        for (const glm::dvec3& p : made.mesh.position_world)
            farthest = std::max(farthest, std::abs(ballMinusBox(p)));
        // Vertices on edges of cells: a root's width, a value's and coordinates' roundings. Others are held
        // in their cells, and sharp edges found to a thousandth of one.
        EXPECT_LE(farthest, mesher == Mesher::kDual ? 0.02 * made.lattice.step : 6 * 0x1p-24 * 1.1);
        ASSERT_EQ(made.mesh.color.size(), made.mesh.triangles.size());
        for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t)
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 &p = made.mesh.position_world[made.mesh.triangles[t][i]],
                                 color = glm::clamp(0.5 + 0.5 * p, 0.0, 1.0);
                // Asked 2 % of the way to the centre, or two reaches of 2^-10 of the largest coordinate; the
                // colour changes half as fast.
                EXPECT_LT(glm::distance(made.mesh.color[t][i], color),
                          0.5 * (0.02 * 2.0 * made.lattice.step + 2.0 * 0x1p-10 * 1.3));
            }
    }
}

TEST_F(MapMesh, RefinesUntilItIsNear) {
    PolygonizeOptions options;
    options.resolution = 24;
    const Scene scene = sceneOf(kBallMinusBox);
    const Polygonized first = polygonize(scene, options);
    const auto distance = measuredDistance(first, scene);
    if (!distance) GTEST_SKIP() << "without CGAL nobody measures";
    const double asked = 0.3 * std::max(distance->mesh_to_surface, distance->surface_to_mesh);
    const MeasuredMesh near = polygonizeWithin(asked, "0.3 of it", "--max-error", scene, options);
    EXPECT_LE(std::max(near.distance.mesh_to_surface, near.distance.surface_to_mesh), asked);
    EXPECT_LT(near.made.lattice.step, first.lattice.step);
}

/// A ball of 20 px: its area is off by no more than its mesh is, 0.2 px all around.
TEST_F(MapMesh, TriangleMethodsMakeTheirPictureOfIt) {
    edgewise::test::FieldPicture picture = edgewise::test::flatPicture(64, 48);
    picture.scene.field = picture.field = std::make_shared<sdf::FieldScene>(
        sdf::loadGlslMap("float map(vec3 p) { return length(p) - 20.0; }\nvec3 albedo(vec3 p, vec3 n) { "
                         "return vec3(1, 0.5, 0); }",
                         "a.map.glsl"));
    MethodResult made;
    try {
        made = picture.made("nsaa");
    } catch (const FailureError& error) {
        GTEST_SKIP() << error.what();
    }
    double area = 0.0;
    for (const glm::dvec4& pixel : made.image.rgba) {
        area += pixel.a;
        EXPECT_NEAR(pixel.g, 0.5 * pixel.r, 1e-12);
    }
    EXPECT_NEAR(area, 400.0 * 3.14159265, 2.0 * 3.14159265 * 20.0 * 0.2);
    ASSERT_FALSE(made.notes.empty());
    EXPECT_NE(made.notes[0].find("polygonized"), std::string::npos);
}

TEST_F(MapMesh, EndsAtACap) {
    PolygonizeOptions options;
    options.resolution = 32;
    options.box = WorldBox{{-1, -1, -1}, {1, 1, 1}}, options.cap = true;
    const Polygonized made = meshOf("float map(vec3 p) { return p.y; }", options);
    const MeshQuality quality = qualityOf(made.mesh);
    EXPECT_TRUE(quality.closed());
    EXPECT_TRUE(quality.manifold());
    // Half of the box, with float's roundings over it.
    EXPECT_NEAR(quality.volume, 4.0, quality.area * 16 * 0x1p-24);
}

TEST_F(MapMesh, SaysWhyThereIsNone) {
    PolygonizeOptions options;
    options.resolution = 16;
    EXPECT_EQ(refusal("float map(vec3 p) { return p.y; }", options),
              "a.map.glsl: is unbounded: a mesh of it needs --box X0,Y0,Z0,X1,Y1,Z1, and --cap where it goes "
              "on beyond");
    EXPECT_EQ(refusal("float map(vec3 p) { return 1e6; }", options), "a.map.glsl: holds no surface");
    EXPECT_NE(refusal("float map(vec3 p) { return 5.0 * (length(p) - 1.0); }", options).find("lipschitz"),
              std::string::npos);
    EXPECT_NE(refusal("float map(vec3 p) { return sqrt(-1.0 - p.y * p.y); }", options).find("not a number"),
              std::string::npos);
    EXPECT_EQ(refusal("float map(vec3 p) { return nope; }", options).rfind("a.map.glsl: line 1", 0), 0u);
    options.box = WorldBox{{-1, -1, -1}, {1, 1, 1}};
    EXPECT_EQ(refusal("float map(vec3 p) { return p.y; }", options),
              "a.map.glsl: surface: it reaches the end of the box: the mesh would be open");
    options.mesher = Mesher::kCgal;
    EXPECT_EQ(refusal("float map(vec3 p) { return length(p) - 0.5; }", options),
              "--mesher: cgal has no raw GLSL; dual and marching-cubes have");
}

TEST_F(MapMesh, ABoundThatLiesIsToldAndLeavesNothingOut) {
    PolygonizeOptions options;
    options.resolution = 32;
    options.box = WorldBox{{-1.25, -1.25, -1.25}, {1.25, 1.25, 1.25}};
    const Polygonized made = meshOf("float map(vec3 p) { return 5.0 * (length(p) - 1.0); }", options);
    ASSERT_EQ(made.notes.size(), 1u);
    EXPECT_EQ(qualityOf(made.mesh).euler, 2);
    const Polygonized told =
        meshOf("// lipschitz: 5\nfloat map(vec3 p) { return 5.0 * (length(p) - 1.0); }", options);
    EXPECT_TRUE(told.notes.empty());
    EXPECT_EQ(told.mesh.triangles.size(), made.mesh.triangles.size());
}

}  // namespace
}  // namespace edgewise::vulkan
