// Animations, skins, morph targets: where vertices end up, computed by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/error.h"
#include "tests/pipeline/feature_gltf.h"
#include "tests/pipeline/load_problem.h"
#include "tests/pipeline/load_scene.h"

namespace edgewise {
namespace {

using test::atTime;
using test::loadTiny;
using test::TinyGltf;

/// World positions of deformed meshes are float32 numbers: half an ulp of the larger, and a few roundings of
/// doubles.
void expectNear(const glm::dvec3& found, const glm::dvec3& wanted) {
    const double bound =
        1.01 * 0x1p-24 * std::max({1.0, std::abs(wanted.x), std::abs(wanted.y), std::abs(wanted.z)});
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], wanted[i], bound) << "axis " << i;
}

/// Joint 0 adds (10, 0, 0). Joint 1 takes p to (10 - (p.y - 2), 2 + p.x, p.z).
TEST(GltfSkin, VerticesFollowTheirJoints) {
    const Geometry g = loadTiny(test::skinnedGltf()).geometry[0];
    expectNear(g.position_world[0], {10, 0, 0});
    // (1, 0, 0): 1/4 of (11, 0, 0), 3/4 of (12, 3, 0).
    expectNear(g.position_world[1], {11.75, 2.25, 0});
    // (0, 1, 0) by joint 1, the weight 2 counting as all of it.
    expectNear(g.position_world[2], {11, 2, 0});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(g.position_world[i], glm::dvec3(g.position_file[i]));
    EXPECT_EQ(g.world_from_file, glm::dmat4(1.0));
}

TEST(GltfSkin, NormalsTurnWithTheBlend) {
    const Geometry g = loadTiny(test::skinnedGltf()).geometry[0];
    const auto direction = [&](std::size_t i) { return glm::normalize(g.normal_world[i]); };
    EXPECT_NEAR(direction(0).z, 1.0, 0x1p-50);
    // Blended rotation rows (1/4, -3/4), (3/4, 1/4): its inverse transpose is itself up to 5/8, so (1, 0) ->
    // (1, 3)/4.
    EXPECT_NEAR(direction(1).x, 1 / std::sqrt(10.0), 0x1p-50);
    EXPECT_NEAR(direction(1).y, 3 / std::sqrt(10.0), 0x1p-50);
    EXPECT_NEAR(direction(2).y, 1.0, 0x1p-50);
}

TEST(GltfSkin, MirroringJointsFlipTheWinding) {
    TinyGltf file = test::skinnedGltf();
    EXPECT_EQ(loadTiny(file).geometry[0].triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    file.root["nodes"][1]["scale"] = {1, 1, -1};
    EXPECT_EQ(loadTiny(file).geometry[0].triangles[0], (std::array<std::uint32_t, 3>{0, 2, 1}));
}

TEST(GltfSkin, SecondSetsOfInfluencesCount) {
    TinyGltf file = test::skinnedGltf();
    // Vertex 0: 1 by joint 0 (first set), 3 by joint 1 (second set): 1/4 of (10, 0, 0) and 3/4 of (12, 2, 0).
    file.primitive()["attributes"]["JOINTS_1"] =
        file.accessor<std::uint16_t>("VEC4", {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    file.primitive()["attributes"]["WEIGHTS_1"] =
        file.accessor<float>("VEC4", {3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    expectNear(loadTiny(file).geometry[0].position_world[0], {11.5, 1.5, 0});
}

TEST(GltfSkin, JointsOutsideTheSceneAreWhereTheFileHasThem) {
    TinyGltf file = test::skinnedGltf();
    file.root["scenes"][0]["nodes"] = {0};
    expectNear(loadTiny(file).geometry[0].position_world[1], {11.75, 2.25, 0});
}

TEST(GltfSkin, BadOnesAreRefused) {
    TinyGltf file = test::skinnedGltf();
    file.root["skins"][0]["joints"] = {1};
    EXPECT_EQ(test::problemOf(file.asGltf()), "nodes[0]: vertex 1 has joint 1, the skin has 1");
    file = test::skinnedGltf();
    file.root["accessors"][1]["count"] = 1;
    EXPECT_EQ(test::problemOf(file.asGltf()),
              "skins[0].inverseBindMatrices: accessors[1] has 1 matrices for 2 joints");
    file = test::skinnedGltf();
    file.root["skins"][0]["inverseBindMatrices"] = 0;
    EXPECT_EQ(test::problemOf(file.asGltf()),
              "skins[0].inverseBindMatrices: accessors[0] is not of float MAT4");
    file = test::skinnedGltf();
    file.primitive()["attributes"]["WEIGHTS_0"] =
        file.accessor<float>("VEC4", {-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    EXPECT_EQ(test::problemOf(file.asGltf()),
              "meshes[0].primitives[0].attributes.WEIGHTS_0: vertex 0 has the weight -1");
}

TEST(GltfMorph, TheMeshsOwnWeightsShowAtRest) {
    const Geometry g = loadTiny(test::morphedGltf()).geometry[0];
    EXPECT_EQ(g.position_world[0], glm::dvec3(1, 0, 0));
    EXPECT_EQ(g.position_world[1], glm::dvec3(2, 0, 2)) << "half of (0, 0, 4)";
    EXPECT_EQ(g.normal_world[1] / g.normal_world[1].z, glm::dvec3(1, 0, 1));
    EXPECT_EQ(g.position_file[1], glm::vec3(1, 0, 2));
    ASSERT_TRUE(g.world_from_file);
    EXPECT_EQ(glm::dvec3((*g.world_from_file)[3]), glm::dvec3(1, 0, 0));
}

TEST(GltfMorph, TheNodesWeightsWin) {
    TinyGltf file = test::morphedGltf();
    file.root["nodes"][0]["weights"] = {0, 0.25};
    const Geometry g = loadTiny(file).geometry[0];
    EXPECT_EQ(g.position_world[1], glm::dvec3(4, 0, 0)) << "1 by the node, 1 by itself, a quarter of 8";
    EXPECT_EQ(g.normal_world[1] / g.normal_world[1].z, glm::dvec3(0, 0, 1));
}

TEST(GltfMorph, TargetsMustFit) {
    TinyGltf file = test::morphedGltf();
    file.primitive()["targets"][0]["POSITION"] = file.accessor<float>("VEC3", {0, 0, 0});
    EXPECT_EQ(test::problemOf(file.asGltf()),
              "meshes[0].primitives[0].targets[0].POSITION: has 1 elements, POSITION has 3");
}

TEST(GltfAnimation, WithoutATimeThePoseIsTheRest) {
    const Geometry g = loadTiny(test::animatedGltf()).geometry[0];
    EXPECT_EQ(g.position_world[0], glm::dvec3(1, 0, 0));
}

/// At 1 s: fraction 1/2 of 2 s. Hermite's basis is 1/2, 1/8, 1/2, -1/8 there, so x = 2 (1/8) 1 + 4/2 - 2
/// (1/8) 2 = 1.75. The turn is a quarter: (x, y) -> (-y, x). The scale has stepped to 3, the weights are at
/// their end (1, 0.5).
TEST(GltfAnimation, EveryInterpolationAtOneSecond) {
    const Geometry g = loadTiny(test::animatedGltf(), atTime(1)).geometry[0];
    // Morphed: (4, 0, 0), (1 + 4, 0, 4), (4, 1, 0).
    expectNear(g.position_world[0], {1.75, 12, 0});
    expectNear(g.position_world[1], {1.75, 15, 12});
    expectNear(g.position_world[2], {1.75 - 3, 12, 0});
}

/// At 1/2 s: fraction 1/4, basis 27/32, 9/64, 5/32, -3/64; scale 1; an eighth of a turn; weights (1/2, 1/4).
TEST(GltfAnimation, EveryInterpolationAtHalfASecond) {
    const Geometry g = loadTiny(test::animatedGltf(), atTime(0.5)).geometry[0];
    const double x = 2 * (9.0 / 64) * 1 + 4 * (5.0 / 32) - 2 * (3.0 / 64) * 2, h = std::sqrt(0.5);
    expectNear(g.position_world[0], {x + 2 * h, 2 * h, 0});
    expectNear(g.position_world[1], {x + 3 * h, 3 * h, 2});
}

TEST(GltfAnimation, ChannelsHoldStillOutsideTheirKeys) {
    const TinyGltf file = test::animatedGltf();
    for (const double before : {-5.0, 0.0}) {
        const Geometry g = loadTiny(file, atTime(before)).geometry[0];
        EXPECT_EQ(g.position_world[1], glm::dvec3(1, 0, 0)) << before;
        EXPECT_EQ(g.world_from_file, glm::dmat4(1.0));
    }
    const Geometry after = loadTiny(file, atTime(99)).geometry[0];
    expectNear(after.position_world[0], {4 - 12, 0, 0});
}

TEST(GltfAnimation, AnimationsAreChosenByNameThenIndex) {
    const TinyGltf file = test::animatedGltf();
    for (const char* name : {"other", "1"})
        EXPECT_EQ(loadTiny(file, atTime(0, name)).geometry[0].position_world[0], glm::dvec3(0, 0, 9)) << name;
    EXPECT_THROW(loadTiny(file, atTime(0, "third")), InputError);
    EXPECT_THROW(loadTiny(file, atTime(0, "2")), InputError);
    EXPECT_THROW(loadTiny(TinyGltf(), atTime(0)), InputError) << "a still file has no time";
}

TEST(GltfAnimation, RotationsTakeTheShorterArc) {
    TinyGltf file;
    const double h = std::sqrt(0.5);
    const int times = file.accessor<float>("SCALAR", {0, 1});
    const int turns = file.accessor<float>("VEC4", {0, 0, 0, 1, 0, 0, float(-h), float(-h)});
    file.root["animations"] = {
        {{"samplers", {{{"input", times}, {"output", turns}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    // -q is a quarter turn: a third of the way is 30 degrees. A float's error in q, doubled, and the scene's
    // doubles.
    const glm::dvec3 x = loadTiny(file, atTime(1.0 / 3)).geometry[0].position_world[1];
    EXPECT_NEAR(x.x, std::cos(std::acos(-1.0) / 6), 4 * 0x1p-24);
    EXPECT_NEAR(x.y, 0.5, 4 * 0x1p-24);
}

TEST(GltfAnimation, BadOnesAreRefusedWhenPlayed) {
    const auto problem = [](const auto& spoil) -> std::string {
        TinyGltf file = test::animatedGltf();
        spoil(file);
        EXPECT_EQ(test::problemOf(file.asGltf()), "") << "at rest nothing is read";
        try {
            loadTiny(file, atTime(1));
        } catch (const InputError& error) {
            const std::string text = error.what();
            return text.substr(text.find("animations["));
        }
        return "";
    };
    EXPECT_EQ(problem([](TinyGltf&) {}), "");
    EXPECT_EQ(problem([](TinyGltf& f) {
                  f.root["animations"][0]["samplers"][0]["input"] = f.accessor<float>("SCALAR", {1, 1});
              }),
              "animations[0].samplers[0].input: time 1 follows 1");
    EXPECT_EQ(problem([](TinyGltf& f) { f.root["animations"][0]["samplers"][0]["output"] = 0; }),
              "animations[0].samplers[0].output: has 9 numbers, not 18 for 2 keys");
    EXPECT_EQ(problem([](TinyGltf& f) { f.root["animations"][0]["samplers"][3]["output"] = 0; }),
              "animations[0].samplers[3].output: its format does not fit weights");
    EXPECT_EQ(problem([](TinyGltf& f) { f.root["animations"][0]["samplers"][0]["input"] = 0; }),
              "animations[0].samplers[0].input: its times are not float scalars");
    EXPECT_EQ(problem([](TinyGltf& f) {
                  f.root["nodes"][0].erase("translation");
                  f.root["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
              }),
              "animations[0].channels[0]: moves a node that has a matrix");
    EXPECT_EQ(problem([](TinyGltf& f) {
                  f.root["animations"][0]["samplers"][2]["output"] =
                      f.accessor<float>("VEC4", std::vector<float>(8));
              }),
              "animations[0].channels[2]: turns its node by the quaternion 0, 0, 0, 0");
}

}  // namespace
}  // namespace edgewise
