// Path tracing against closed forms, and its two ways to light against each other.
#include "sdf/path_tracer.h"

#include <gtest/gtest.h>

#include <random>

#include "sdf/shading_text.h"
#include "tests/sdf/classic_tracer.h"

namespace edgewise::sdf {
namespace {

using test::ClassicTracer, test::rayAlong, test::sceneOf;

class RandomSampler : public PathSampler {
  public:
    explicit RandomSampler(std::uint64_t seed) : random_(seed) {}
    glm::dvec2 pair(std::uint32_t) override {
        const double x = unit_(random_);
        return {x, unit_(random_)};
    }

  private:
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

SurfaceMaterial material(double albedo, double emission) {
    SurfaceMaterial made;
    made.color = glm::dvec3(albedo);
    made.emission = glm::dvec3(emission);
    return made;
}

struct Estimate {
    double mean, deviation;  ///< of the mean: its standard error
    RayCounts counts;
};

Estimate estimate(const FieldScene& scene, const FieldRay& ray, int paths, PathSettings settings,
                  std::uint64_t seed = 3) {
    const ClassicTracer tracer(scene);
    const PathTracer path(shadingOf(scene, {}), scene.analytic, tracer, settings);
    RandomSampler sampler(seed);
    Estimate out{};
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < paths; ++i) {
        const double seen = path.radiance(ray, sampler, out.counts).r;
        sum += seen, squares += seen * seen;
    }
    out.mean = sum / paths;
    out.deviation = std::sqrt(std::max(squares / paths - out.mean * out.mean, 0.0) / paths);
    return out;
}

/// 1 + a + ... + a^depth.
double series(double a, int depth) {
    return (1.0 - std::pow(a, depth + 1)) / (1.0 - a);
}

TEST(PathTracer, AnEmissiveCavityIsTheGeometricSeries) {
    const double a = 0.7, e = 0.25;
    FieldScene field = sceneOf(Kind::kSphere, {1.0}, material(a, e));
    field.tree.root = field.tree.add(Kind::kComplement, {}, {0});
    FieldScene analytic;
    analytic.materials = {material(a, e)};
    analytic.analytic = {AnalyticShape{}};
    for (const FieldScene* scene : {&field, &analytic})
        for (const int depth : {0, 1, 10, 60}) {
            const FieldRay ray = rayAlong({0.3, 0.1, 0}, {1, 2, 3});
            const double truth = e * series(a, depth);
            const Estimate whole = estimate(*scene, ray, 20, {depth, depth});
            EXPECT_NEAR(whole.mean, truth, 1e-12 * truth) << depth;
            EXPECT_LT(whole.deviation, 1e-7);  // the root of a rounding of the squares
            const Estimate chance = estimate(*scene, ray, 3000, {depth, 3});
            EXPECT_NEAR(chance.mean, truth, 4.0 * chance.deviation + 1e-12) << depth;
            EXPECT_LT(chance.counts.scattered, 3000u * 20);
        }
}

TEST(PathTracer, AConvexBodyUnderAnEvenSkyShowsItsAlbedo) {
    FieldScene scene = sceneOf(Kind::kSphere, {1.0}, material(0.6, 0.0));
    scene.background = glm::dvec3(2.0);
    const Estimate seen = estimate(scene, rayAlong({0.2, 0.4, 3}, {0, 0, -1}), 50, {});
    EXPECT_NEAR(seen.mean, 1.2, 1e-12);
    // So does clear glass, whatever way its light takes.
    scene.materials[0].transmittance = 1.0;
    const Estimate glass = estimate(scene, rayAlong({0.2, 0.4, 3}, {0, 0, -1}), 200, {100, 100});
    EXPECT_NEAR(glass.mean, 2.0, 1e-12);
    EXPECT_GT(glass.counts.reflection, 0u);
}

TEST(PathTracer, ASphereLightGivesItsClosedForm) {
    // pi L (r / d)^2 cos: the sphere is wholly above the plane.
    FieldScene scene = sceneOf(Kind::kPlane, {0, 1, 0, 0}, material(0.8, 0.0));
    scene.materials.push_back(material(0.0, 5.0));
    AnalyticShape lamp;
    lamp.center_world = {0.6, 1.5, -0.4};
    lamp.radius = 0.5;
    lamp.material = 1;
    scene.analytic = {lamp};
    for (const double x : {-2.0, 0.0, 0.6}) {
        const double distance = length(lamp.center_world - glm::dvec3(x, 0, 0));
        const double cosine = 1.5 / distance;
        const double truth = 0.8 * 5.0 * 0.25 / (distance * distance) * cosine;
        for (const bool next_event : {true, false}) {
            const Estimate seen =
                estimate(scene, rayAlong({x, 0.3, 0}, {0, -1, 0}), 40000, {1, 3, next_event});
            EXPECT_NEAR(seen.mean, truth, 4.0 * seen.deviation);
            EXPECT_GT(seen.deviation, 0.0);
            std::printf("x %4.1f, %s: %.5f +- %.5f, closed form %.5f\n", x, next_event ? "looked for" : "met",
                        seen.mean, seen.deviation, truth);
        }
    }
}

/// A room corner with a field box that shades it, a mirror ball and a small lamp.
FieldScene corner() {
    FieldScene scene = sceneOf(Kind::kBox, {0.6, 0.6, 0.6}, material(0.7, 0.0));
    scene.materials.push_back(material(0.5, 6.0));
    scene.materials.push_back(material(0.0, 0.0));
    scene.materials.back().reflectance = 1.0;
    AnalyticShape floor;
    floor.type = AnalyticShape::Type::kPlane;
    floor.offset = -0.5;
    AnalyticShape wall = floor;
    wall.normal_world = {1, 0, 0};
    wall.offset = -1.2;
    AnalyticShape lamp;
    lamp.center_world = {0.5, 1.2, 0.2};
    lamp.radius = 0.3;
    lamp.material = 1;
    AnalyticShape ball;
    ball.center_world = {-0.7, -0.2, 0.6};
    ball.radius = 0.3;
    ball.material = 2;
    scene.analytic = {floor, wall, lamp, ball};
    scene.background = glm::dvec3(0.1);
    return scene;
}

TEST(PathTracer, LookingForLightsChangesTheSpreadAndNotTheMean) {
    const FieldScene scene = corner();
    for (const double x : {-0.9, -0.45, 0.6}) {
        const FieldRay ray = rayAlong({x, 0.8, 0.1}, {0, -1, 0});
        const Estimate looked = estimate(scene, ray, 20000, {10, 3, true}, 5);
        const Estimate met = estimate(scene, ray, 20000, {10, 3, false}, 6);
        EXPECT_NEAR(looked.mean, met.mean, 4.0 * std::hypot(looked.deviation, met.deviation));
        EXPECT_LT(looked.deviation, met.deviation);
        std::printf("x %5.2f: looked for %.4f +- %.4f, met %.4f +- %.4f\n", x, looked.mean, looked.deviation,
                    met.mean, met.deviation);
    }
}

TEST(PathTracer, APointLightIsWhatTheShaderMakesOfItAtDepthOne) {
    FieldScene scene = corner();
    scene.analytic.resize(2);
    SurfaceLight lamp;
    lamp.type = SurfaceLight::Type::kPoint;
    lamp.position_world = {1, 2, 1};
    scene.lights = {lamp};
    scene.background = glm::dvec3(0.0);
    const Estimate seen = estimate(scene, rayAlong({0.5, 1, 0.6}, {0, -1, 0}), 5, {1, 3});
    const glm::dvec3 p{0.5, -0.5, 0.6};
    const double distance = length(lamp.position_world - p);
    EXPECT_NEAR(seen.mean, 0.7 / M_PI * 2.5 / (distance * distance * distance), 1e-6);
}

TEST(PathTracer, DirectionsHaveTheirDensities) {
    // Means over a lattice of (u, v): of the cosine under cos / pi, 2/3; within a cone, its middle.
    const glm::dvec3 n = normalize(glm::dvec3(0.3, -0.5, -0.8));
    double cosines = 0.0, cone = 0.0, worst = 0.0;
    const int side = 200;
    const double versine = shading::versineOfSphere(0.3, 1.0);
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const double u = (i + 0.5) / side, v = (j + 0.5) / side;
            const glm::dvec3 a = shading::cosineDirection(n, u, v),
                             b = shading::coneDirection(n, versine, u, v);
            worst = std::max({worst, std::abs(length(a) - 1.0), std::abs(length(b) - 1.0)});
            EXPECT_GE(dot(b, n), 1.0 - versine - 1e-15);
            cosines += dot(a, n) / (side * side);
            cone += (1.0 - dot(b, n)) / (side * side);
        }
    EXPECT_LT(worst, 1e-14);
    EXPECT_NEAR(cosines, 2.0 / 3.0, 1.0 / (side * side));  // the midpoint rule's error, at the root
    EXPECT_NEAR(cone, 0.5 * versine, 1e-12);
    EXPECT_NEAR(versine, 1.0 - std::sqrt(1.0 - 0.09), 1e-15);
}

}  // namespace
}  // namespace edgewise::sdf
