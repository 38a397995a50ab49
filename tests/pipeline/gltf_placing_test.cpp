// Lights and instances: where nodes put them.
#include <gtest/gtest.h>

#include "pipeline/coplanar.h"
#include "pipeline/error.h"
#include "tests/pipeline/feature_gltf.h"
#include "tests/pipeline/load_problem.h"
#include "tests/pipeline/load_scene.h"

namespace edgewise {
namespace {

using test::loadTiny;
using test::TinyGltf;

TEST(GltfLights, NodesPlaceAndPointThem) {
    const Scene scene = loadTiny(test::litGltf());
    ASSERT_EQ(scene.lights.size(), 2u);
    const Light& lamp = scene.lights[0];
    EXPECT_EQ(lamp.type, Light::Type::kSpot);
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.node, 1u);
    EXPECT_EQ(lamp.color, glm::dvec3(1, 0.5, 0.25));
    EXPECT_EQ(lamp.intensity, 40.0);
    EXPECT_EQ(lamp.range, 12.0);
    EXPECT_EQ(lamp.inner_cone_angle, 0.25);
    EXPECT_EQ(lamp.outer_cone_angle, 0.5);
    EXPECT_EQ(lamp.position_world, glm::dvec3(2, 5, 6)) << "(0, 1, 0) + 2 (1, 2, 3)";
    // A unit vector of a quaternion's rotation: a few roundings.
    EXPECT_NEAR(lamp.direction_world.x, -1.0, 8 * 0x1p-53);
    EXPECT_NEAR(lamp.direction_world.z, 0.0, 8 * 0x1p-53);
    const Light& sun = scene.lights[1];
    EXPECT_EQ(sun.type, Light::Type::kDirectional);
    EXPECT_EQ(sun.direction_world, glm::dvec3(0, 0, -1));
    EXPECT_EQ(sun.color, glm::dvec3(1.0));
    EXPECT_EQ(sun.intensity, 1.0);
    EXPECT_FALSE(sun.range);
}

TEST(GltfLights, BadOnesAreRefusedAndUnknownOnesCounted) {
    const auto problem = [](const auto& spoil) {
        TinyGltf file = test::litGltf();
        spoil(file.root["extensions"]["KHR_lights_punctual"]["lights"], file.root["nodes"]);
        return test::problemOf(file.asGltf());
    };
    const std::string lights = "extensions.KHR_lights_punctual.lights";
    EXPECT_EQ(problem([](auto& l, auto&) { l[0]["spot"]["innerConeAngle"] = 0.5; }),
              lights + "[0].spot: its cones of 0.5 and 0.5 are not 0 <= inner < outer <= pi/2");
    EXPECT_EQ(problem([](auto& l, auto&) { l[0]["range"] = 0; }), lights + "[0].range: 0 is not above 0");
    EXPECT_EQ(problem([](auto& l, auto&) { l[0]["intensity"] = -1; }),
              lights + "[0].intensity: -1 is negative");
    EXPECT_EQ(problem([](auto& l, auto&) { l[1].erase("type"); }), lights + "[1]: type is missing");
    EXPECT_EQ(problem([](auto& l, auto&) { l.erase(1); }),
              "nodes[2].extensions.KHR_lights_punctual.light: 1 is out of range: the file has 1 lights");
    EXPECT_EQ(problem([](auto&, auto& n) {
                  n[1]["scale"] = {1, 1, 0};
              }),
              "nodes[1]: its light has no direction: the z axis of the node vanishes");
    TinyGltf file = test::litGltf();
    file.root["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "area";
    const Scene scene = loadTiny(file);
    EXPECT_EQ(scene.lights.size(), 1u);
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].what, "lights of an unknown type");
}

TEST(GltfInstancing, EachInstanceIsACopyInOrder) {
    const Scene scene = loadTiny(test::instancedGltf());
    ASSERT_EQ(scene.geometry.size(), 3u);
    EXPECT_EQ(scene.triangle_count, 3u);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(scene.geometry[i].instance, i);
        EXPECT_EQ(scene.geometry[i].first_triangle, i);
        EXPECT_EQ(scene.geometry[i].node, 0u);
    }
    EXPECT_EQ(scene.geometry[0].position_world[1], glm::dvec3(101, 0, 0));
    EXPECT_EQ(scene.geometry[1].position_world[1], glm::dvec3(99, 10, 0)) << "half a turn";
    EXPECT_EQ(scene.geometry[2].position_world[1], glm::dvec3(102, 20, 0));
    EXPECT_EQ(scene.geometry[2].triangles[0][1], 2u) << "mirrored: wound the other way";
}

/// Planes are shared within an instance, never between two, which lie elsewhere.
TEST(GltfInstancing, InstancesHavePlanesOfTheirOwn) {
    const Scene scene = loadTiny(test::instancedGltf());
    EXPECT_EQ(findCoplanar(scene).plane_of, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(GltfInstancing, AttributesMustFit) {
    TinyGltf file = test::instancedGltf();
    auto& attributes = file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    const std::string where = "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes";
    attributes["SCALE"] = file.accessor<float>("VEC3", {1, 1, 1});
    EXPECT_EQ(test::problemOf(file.asGltf()), where + ": an attribute has 3 instances, another 1");
    attributes["SCALE"] = 2;
    EXPECT_EQ(test::problemOf(file.asGltf()),
              where + ".SCALE: accessors[2] has another format than SCALE needs");
    attributes = {{"_ID", 0}};
    EXPECT_EQ(test::problemOf(file.asGltf()), where + ": has none of TRANSLATION, ROTATION and SCALE");
    attributes["TRANSLATION"] = 77;
    EXPECT_TRUE(test::problemOf(file.asGltf()).starts_with(where + ".TRANSLATION: 77 is out of range"));
}

}  // namespace
}  // namespace edgewise
