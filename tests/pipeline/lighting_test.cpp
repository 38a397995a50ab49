#include "pipeline/lighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

/// Two products and their sum, a root and a quotient, or the cosines of a cone: under sixteen roundings.
constexpr double kError = 16 * 0x1p-53;

Lighting lightingOf(const Light& light, const ResolvedCamera& camera = test::makePerspective()) {
    Scene scene;
    scene.lights = {light};
    return Lighting(scene, camera);
}

TEST(Lighting, PointLightsFallOffWithTheSquare) {
    Light light;
    light.color = {1, 0.5, 0.25};
    light.intensity = 100;
    light.position_world = {0, 3, -4};
    const Arrival at = lightingOf(light).arrival(0, glm::dvec3(0.0));
    EXPECT_EQ(at.towards, glm::dvec3(0, 0.6, -0.8));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(at.illuminance[k], 4 * light.color[k], 4 * kError);
    EXPECT_EQ(lightingOf(light).arrival(0, light.position_world).illuminance, glm::dvec3(0.0));
}

TEST(Lighting, RangeIsAWindow) {
    Light light;
    light.intensity = 1;
    light.range = 4.0;
    const Lighting lighting = lightingOf(light);
    const auto at = [&](double d) { return lighting.arrival(0, {0, 0, -d}).illuminance.r; };
    EXPECT_NEAR(at(2), (1 - 1 / 16.0) / 4, kError);
    EXPECT_NEAR(at(1), 1 - 1 / 256.0, kError);
    EXPECT_EQ(at(4), 0.0);
    EXPECT_EQ(at(5), 0.0);
}

TEST(Lighting, SpotsDimFromTheInnerToTheOuterCone) {
    Light light;
    light.type = Light::Type::kSpot;
    light.inner_cone_angle = 0.2, light.outer_cone_angle = 0.6;
    light.direction_world = {0, 0, -1};
    const Lighting lighting = lightingOf(light);
    const auto at = [&](double angle) {
        return lighting.arrival(0, 2.0 * glm::dvec3(std::sin(angle), 0, -std::cos(angle))).illuminance.r;
    };
    EXPECT_NEAR(at(0.0), 0.25, kError);
    EXPECT_NEAR(at(0.19), 0.25, kError);
    const double share = (std::cos(0.4) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
    EXPECT_NEAR(at(0.4), share * share / 4, 4 * kError / (std::cos(0.2) - std::cos(0.6)));
    EXPECT_GT(at(0.59), 0.0);
    EXPECT_EQ(at(0.61), 0.0);
    EXPECT_EQ(at(3.0), 0.0);
}

TEST(Lighting, DirectionsFollowTheCamera) {
    Light light;
    light.type = Light::Type::kDirectional;
    light.intensity = 7;
    light.direction_world = {1, 0, 0};
    ResolvedCamera camera = test::makeOrthographic(1);
    camera.camera_from_world = glm::rotate(glm::dmat4(1.0), M_PI_2, glm::dvec3(0, 0, 1));  // +x goes to +y
    const Lighting lighting = lightingOf(light, camera);
    const Arrival near = lighting.arrival(0, {0, 0, -1}), far = lighting.arrival(0, {5, 6, -1e6});
    EXPECT_NEAR(near.towards.y, -1, kError);
    EXPECT_EQ(near.towards, far.towards);
    EXPECT_EQ(near.illuminance, glm::dvec3(7.0));
    EXPECT_EQ(far.illuminance, glm::dvec3(7.0));
}

TEST(Lighting, IsUniformWhereNothingDependsOnThePlace) {
    Light sun;
    sun.type = Light::Type::kDirectional;
    const Light lamp;
    EXPECT_TRUE(Lighting({}, test::makePerspective()).isUniform());
    EXPECT_TRUE(Lighting({}, test::makePerspective()).isRig());
    EXPECT_TRUE(lightingOf(sun, test::makeOrthographic(1)).isUniform());
    EXPECT_FALSE(lightingOf(sun).isUniform());
    EXPECT_FALSE(lightingOf(lamp, test::makeOrthographic(1)).isUniform());
    EXPECT_FALSE(lightingOf(sun).isRig());
}

TEST(Lighting, IsSeenFromTheEye) {
    const glm::dvec3 p(3, 0, -4);
    EXPECT_EQ(lightingOf(Light()).view(p), glm::dvec3(-0.6, 0, 0.8));
    EXPECT_EQ(lightingOf(Light(), test::makeOrthographic(1)).view(p), glm::dvec3(0, 0, 1));
    EXPECT_EQ(Lighting({}, test::makePerspective()).view(p), glm::dvec3(0, 0, 1));
}

TEST(Lighting, TheRigGivesItsIntensityFromWhiteLambert) {
    const Lighting rig({}, test::makePerspective());
    ASSERT_EQ(rig.count(), 2u);
    EXPECT_NEAR(rig.arrival(0, {}).illuminance.r / M_PI, 0.8, kError);
    EXPECT_NEAR(rig.arrival(1, {}).illuminance.r / M_PI, 0.2, kError);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(glm::length(rig.arrival(i, {}).towards), 1, kError);
    EXPECT_EQ(rig.arrival(0, {}).towards, glm::dvec3(2, 3, 6) / 7.0);
}

}  // namespace
}  // namespace edgewise
