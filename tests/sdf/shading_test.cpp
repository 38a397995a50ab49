// Lights, shadows, mirrors and glass against closed forms.
#include <gtest/gtest.h>

#include <random>

#include "sdf/shader.h"
#include "sdf/shading_text.h"
#include "tests/sdf/classic_tracer.h"

namespace edgewise::sdf {
namespace {

using test::ClassicTracer, test::rayAlong, test::sceneOf;

SurfaceMaterial white() {
    SurfaceMaterial material;
    material.color = glm::dvec3(1.0);
    return material;
}
SurfaceMaterial glass(double ior = 1.5) {
    SurfaceMaterial material = white();
    material.transmittance = 1.0;
    material.ior = ior;
    return material;
}
SurfaceLight sun(const glm::dvec3& towards, double lux) {
    SurfaceLight light;
    light.direction_world = -normalize(towards);
    light.intensity = lux;
    return light;
}

/// A scene with its tracer and shader.
struct Lit {
    FieldScene scene;
    ClassicTracer tracer;
    Shader shader;
    mutable RayCounts counts;

    explicit Lit(FieldScene s) : scene(std::move(s)), tracer(scene), shader(shadingOf(scene, {}), tracer) {}
    glm::dvec4 seen(const FieldRay& ray, double sign = 1.0) const {
        return shader.radiance(ray, counts, sign);
    }
    /// The ray that goes on through the first surface it meets.
    TravellingRay through(const TravellingRay& from) const {
        const SurfaceHit hit = tracer.nearest(from.ray, from.sign);
        EXPECT_TRUE(hit.hit);
        const SurfacePoint point = surfacePoint(shader.settings(), from, hit);
        const glm::dvec3 direction = shading::refracted(from.ray.direction_world, point.normal, point.eta);
        return rayThrough(shader.settings(), from, hit, point, direction);
    }
};

/// The mean over a square of parallel rays around a unit sphere, from +z.
double fluxOfSphere(const Lit& lit, int side) {
    double sum = 0.0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double u = 2.0 * (x + 0.5) / side - 1.0, v = 2.0 * (y + 0.5) / side - 1.0;
            sum += lit.seen(rayAlong({u, v, 3.0}, {0, 0, -1})).r;
        }
    return sum * 4.0 / (side * side);
}

TEST(SdfShading, ALambertSphereSendsWhatItsPhaseFunctionSays) {
    for (const double degrees : {0.0, 40.0, 100.0}) {
        const double angle = degrees * M_PI / 180.0, lux = 3.0, albedo = 0.6;
        FieldScene scene = sceneOf(Kind::kSphere, {1.0}, white());
        scene.materials[0].color = glm::dvec3(albedo);
        scene.lights = {sun({std::sin(angle), 0.0, std::cos(angle)}, lux)};
        const Lit lit(scene);
        const double coarse = fluxOfSphere(lit, 64), fine = fluxOfSphere(lit, 128);
        const double truth =
            albedo * lux * (2.0 / 3.0) * (std::sin(angle) + (M_PI - angle) * std::cos(angle)) / M_PI;
        // What halving took, and what a lattice is off by along the outline.
        EXPECT_NEAR(fine, truth, std::abs(fine - coarse) + 1e-3 * truth) << degrees;
        std::printf("phase %3.0f degrees: %.6f, closed form %.6f\n", degrees, fine, truth);
    }
}

TEST(SdfShading, APointLightFallsWithTheSquareAndTheCosine) {
    FieldScene scene = sceneOf(Kind::kPlane, {0, 1, 0, 0}, white());
    SurfaceLight lamp;
    lamp.type = SurfaceLight::Type::kPoint;
    lamp.position_world = {0, 2, 0};
    lamp.intensity = 5.0;
    scene.lights = {lamp};
    const Lit lit(scene);
    for (const double x : {0.0, 0.5, 3.0}) {
        const double square = x * x + 4.0;
        const double truth = 5.0 / square * 2.0 / std::sqrt(square) / M_PI;
        EXPECT_NEAR(lit.seen(rayAlong({x, 9, 0}, {0, -1, 0})).r, truth, 1e-11 * truth);
    }
}

TEST(SdfShading, ASpheresShadowHasItsExactOutline) {
    FieldScene scene = sceneOf(Kind::kSphere, {0.7}, white());
    AnalyticShape floor;
    floor.type = AnalyticShape::Type::kPlane;
    floor.offset = -1.0;
    scene.analytic = {floor};
    SurfaceLight lamp;
    lamp.type = SurfaceLight::Type::kPoint;
    lamp.position_world = {1.0, 2.0, 0.3};
    const SurfaceLight far_away = sun({1.0, 2.0, 0.3}, 1.0);
    const std::uint64_t seed = 11;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> where(-3.0, 3.0);
    for (const SurfaceLight& light : {far_away, lamp}) {
        scene.lights = {light};
        const Lit lit(scene);
        int dark = 0, near = 0;
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec3 p{where(random), -1.0, where(random)};
            const glm::dvec3 towards = arrivalOf(light, p).towards;
            const double miss = length(p - towards * dot(p, towards)) - 0.7;  // from the line to the light
            if (std::abs(miss) < 2e-5) continue;  // the shadow ray's offset, 2e-6 of at most 5
            const bool shadow = lit.seen(rayAlong(p + glm::dvec3(0, 0.1, 0), {0, -1, 0})).r == 0.0;
            EXPECT_EQ(shadow, miss < 0.0) << "seed " << seed << " miss " << miss;
            dark += shadow;
            near += std::abs(miss) < 0.02;
        }
        EXPECT_GT(dark, 100);
        EXPECT_GT(near, 20);
        EXPECT_GT(lit.counts.shadow, 3000u);
    }
}

TEST(SdfShading, ALightWithoutShadowsReachesBehindThings) {
    FieldScene scene = sceneOf(Kind::kSphere, {0.7}, white());
    AnalyticShape floor;
    floor.type = AnalyticShape::Type::kPlane;
    floor.offset = -1.0;
    scene.analytic = {floor};
    scene.lights = {sun({0, 1, 0}, 1.0)};
    scene.ambient = glm::dvec3(0.125);
    EXPECT_EQ(Lit(scene).seen(rayAlong({0, -0.9, 0}, {0, -1, 0})).r, 0.125);
    scene.lights[0].shadows = false;
    EXPECT_NEAR(Lit(scene).seen(rayAlong({0, -0.9, 0}, {0, -1, 0})).r, 0.125 + 1.0 / M_PI, 1e-12);
}

TEST(SdfShading, FresnelsSharesAreWhatTheTransmittedAmplitudesLeave) {
    double worst = 0.0;
    int total = 0;
    for (const double eta : {1.5, 1.0 / 1.5, 2.4, 1.0 / 2.4, 1.0})
        for (int i = 1; i <= 1000; ++i) {
            const double c = i / 1000.0, sin_t = std::sqrt(1.0 - c * c) / eta;
            if (sin_t >= 1.0) {
                EXPECT_EQ(shading::fresnelShare(c, eta), 1.0);
                ++total;
                continue;
            }
            const double t = std::sqrt(1.0 - sin_t * sin_t);
            const double s = 2.0 * c / (c + eta * t), p = 2.0 * c / (eta * c + t);
            const double through = eta * t / c * 0.5 * (s * s + p * p);
            worst = std::max(worst, std::abs(shading::fresnelShare(c, eta) + through - 1.0));
        }
    EXPECT_GT(total, 400);
    EXPECT_LT(worst, 1e-13);
    EXPECT_NEAR(shading::fresnelShare(1.0, 1.5), 0.04, 1e-16);
    std::printf("|R + T - 1| at most %.2g\n", worst);
}

TEST(SdfShading, SharesOfASurfaceSumToOne) {
    for (const double mirror : {0.0, 0.3, 1.0})
        for (const double transmittance : {0.0, 0.7, 1.0})
            for (const double fresnel : {0.0, 0.04, 1.0}) {
                const glm::dvec3 shares = shading::surfaceShares(mirror, transmittance, fresnel);
                EXPECT_NEAR(shares.x + shares.y + shares.z, 1.0, 4e-16);
                EXPECT_GE(std::min(shares.x, std::min(shares.y, shares.z)), 0.0);
            }
}

TEST(SdfShading, AMirrorSphereShowsWhatItsGeometrySays) {
    // A ray at height h over the axis meets the unit sphere at angle i, sin i = h, and leaves 2 i from where
    // it came.
    const Lit lit(sceneOf(Kind::kSphere, {1.0}, white()));
    for (const double h : {0.0, 0.1, 0.5, 0.9}) {
        const TravellingRay from{rayAlong({h, 0, 4}, {0, 0, -1})};
        const SurfaceHit hit = lit.tracer.nearest(from.ray, 1.0);
        const glm::dvec3 n = surfacePoint(lit.shader.settings(), from, hit).normal;
        const glm::dvec3 out = shading::mirrored(from.ray.direction_world, n);
        const double angle = 2.0 * std::asin(h);
        EXPECT_NEAR(out.x, std::sin(angle), 1e-11);
        EXPECT_NEAR(out.z, std::cos(angle), 1e-11);
    }
}

TEST(SdfShading, ASlabMovesARayBySnellsOffset) {
    const double thick = 0.8, ior = 1.5;
    const Lit lit(sceneOf(Kind::kBox, {100, 100, thick}, glass(ior)));
    for (const double degrees : {0.0, 20.0, 60.0, 80.0}) {
        const double i = degrees * M_PI / 180.0, t = std::asin(std::sin(i) / ior);
        const TravellingRay from{
            rayAlong({-std::tan(i) * 2.0, 0, 2.0 + 0.5 * thick}, {std::sin(i), 0, -std::cos(i)})};
        const TravellingRay inside = lit.through(from), out = lit.through(inside);
        EXPECT_EQ(inside.sign, -1.0);
        EXPECT_EQ(out.sign, 1.0);
        EXPECT_EQ(out.medium, kNoMaterial);
        EXPECT_NEAR(length(out.ray.direction_world - from.ray.direction_world), 0.0, 1e-13);
        const glm::dvec3 way = out.ray.origin_world - from.ray.origin_world;
        const glm::dvec3 across = way - from.ray.direction_world * dot(way, from.ray.direction_world);
        // Both offsets are at most 2e-6 of a way of 20; each moves the ray across by less than itself.
        EXPECT_NEAR(length(across), thick * std::sin(i - t) / std::cos(t), 2.0 * 2e-6 * 20.0) << degrees;
    }
}

TEST(SdfShading, AGlassSphereTurnsARayTwice) {
    const double ior = 1.5;
    const Lit lit(sceneOf(Kind::kSphere, {1.0}, glass(ior)));
    for (const double h : {0.0, 0.2, 0.7, 0.95}) {
        const TravellingRay from{rayAlong({h, 0, 3}, {0, 0, -1})};
        const TravellingRay out = lit.through(lit.through(from));
        const double turn = 2.0 * (std::asin(h) - std::asin(h / ior));
        // The offset, 2e-6 of at most 5, moves the second hit on the sphere, where directions turn by up to
        // (tan i + 1) radians a unit.
        EXPECT_NEAR(out.ray.direction_world.x, -std::sin(turn), 1e-4) << h;
        EXPECT_NEAR(out.ray.direction_world.z, -std::cos(turn), 1e-4) << h;
    }
}

TEST(SdfShading, GlassDarkensByBeersLawAndMirrorsWithinItsBounces) {
    FieldScene scene = sceneOf(Kind::kBox, {10, 10, 1}, glass());
    scene.materials[0].absorption = {0.1, 0.5, 1.0};
    scene.background = glm::dvec3(1.0);
    const double r = 0.04;
    for (const int reflections : {0, 1, 2}) {
        scene.reflections = reflections;
        const glm::dvec4 seen = Lit(scene).seen(rayAlong({0, 0, 3}, {0, 0, -1}));
        for (int c = 0; c < 3; ++c) {
            const double a = std::exp(-scene.materials[0].absorption[c]);
            double truth = (1 - r) * (1 - r) * a;
            if (reflections >= 1) truth += r + (1 - r) * (1 - r) * r * a * a;
            if (reflections >= 2) truth += (1 - r) * (1 - r) * r * r * a * a * a;
            // The way through is shorter by the offset.
            EXPECT_NEAR(seen[c], truth, 2e-5) << reflections;
        }
        EXPECT_EQ(seen.a, 1.0);
    }
}

TEST(SdfShading, WhatIsReflectedWhollyGoesOnAsRefraction) {
    // In through the top of a cube at 45 degrees, to its side at 62, out of the bottom.
    FieldScene scene = sceneOf(Kind::kBox, {2, 2, 2}, glass());
    scene.background = glm::dvec3(1.0);
    scene.reflections = 0;
    const Lit lit(scene);
    const double share = 1.0 - shading::fresnelShare(std::sqrt(0.5), 1.5);
    EXPECT_NEAR(lit.seen(rayAlong({-0.5, 2.0, 0}, {1, -1, 0})).r, share * share, 1e-12);
    EXPECT_EQ(lit.counts.refraction, 3u);
    EXPECT_EQ(lit.counts.reflection, 0u);
    scene.refractions = 2;
    EXPECT_EQ(Lit(scene).seen(rayAlong({-0.5, 2.0, 0}, {1, -1, 0})).r, 0.0);
}

TEST(SdfShading, ClearGlassUnderAnEvenSkyIsAsBrightAsTheSky) {
    FieldScene scene = sceneOf(Kind::kSphere, {1.0}, glass());
    scene.background = glm::dvec3(1.0);
    scene.reflections = 12, scene.refractions = 12;
    const Lit lit(scene);
    for (const double h : {0.0, 0.5, 0.9, 0.99}) {
        const double seen = lit.seen(rayAlong({h, 0, 3}, {0, 0, -1})).r;
        EXPECT_LT(seen, 1.0 + 1e-12);
        EXPECT_GT(seen, 1.0 - 4.0 * Shader::kLeastShare) << h;  // a chain: what is left of it once it ends
    }
}

TEST(SdfShading, MirrorsSeeEachOtherAsOftenAsTheSceneSays) {
    FieldScene scene;
    SurfaceMaterial mirror = white();
    mirror.reflectance = 1.0;
    scene.materials = {mirror};
    for (const double side : {-1.0, 1.0}) {
        AnalyticShape wall;
        wall.type = AnalyticShape::Type::kPlane;
        wall.normal_world = {0, 0, 1};
        wall.offset = side;
        scene.analytic.push_back(wall);
    }
    scene.background = glm::dvec3(1.0);
    for (const int reflections : {0, 2, 7}) {
        scene.reflections = reflections;
        const Lit lit(scene);
        EXPECT_EQ(lit.seen(rayAlong({0, 0, 0}, {0.1, 0, 1})).r, 0.0);
        EXPECT_EQ(lit.counts.reflection, std::uint64_t(reflections));
    }
}

TEST(SdfShading, PatternsLieInTheShapesOwnFrame) {
    FieldScene scene;
    SurfaceMaterial checker = white();
    checker.shading = SurfaceMaterial::Shading::kUnlit;
    checker.pattern = SurfaceMaterial::Pattern::kChecker;
    checker.pattern_size = 0.5;
    scene.materials = {checker};
    const auto box = scene.tree.add(Kind::kBox, {2, 2, 2}, {}, 0);
    scene.tree.root = scene.tree.add(Kind::kTranslate, {0.5, 0, 0}, {box});
    const Lit lit(scene);
    for (const double x : {-0.4, -0.1, 0.3, 0.6, 1.2})
        for (const double y : {-0.6, 0.2}) {
            // The face z = 1 of the child's frame, a hair inside or outside of the cube that ends there.
            const double sum = std::floor((x - 0.5) / 0.5) + std::floor(y / 0.5);
            const bool odd = std::fmod(std::abs(sum), 2.0) == 1.0;
            const double seen = lit.seen(rayAlong({x, y, 3}, {0, 0, -1})).r;
            const double z = lit.tracer.nearest(rayAlong({x, y, 3}, {0, 0, -1}), 1.0).p_local.z;
            EXPECT_EQ(seen, odd != (z < 1.0) ? 0.0 : 1.0) << x << " " << y << " " << z - 1.0;
        }
    scene.materials[0].pattern = SurfaceMaterial::Pattern::kStripes;
    scene.materials[0].pattern_axis = {2, 0, 0};
    const Lit striped(scene);
    EXPECT_EQ(striped.seen(rayAlong({0.55, 0, 3}, {0, 0, -1})).r, 1.0);
    EXPECT_EQ(striped.seen(rayAlong({0.80, 0, 3}, {0, 0, -1})).r, 0.0);
    EXPECT_EQ(striped.seen(rayAlong({1.05, 0, 3}, {0, 0, -1})).r, 1.0);
}

TEST(SdfShading, ABlinnPhongHighlightSendsAboutItsSpecularShare) {
    // Light and normal along +z: the directional-hemispherical share by quadrature over views.
    SurfaceMaterial shiny = white();
    shiny.color = glm::dvec3(0.0);
    for (const double shininess : {16.0, 32.0, 200.0}) {
        double sum = 0.0;
        const int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double angle = (i + 0.5) / steps * M_PI / 2.0;
            const glm::dvec3 view{std::sin(angle), 0, std::cos(angle)};
            sum += shading::blinnPhongShare(glm::dvec3(0.0), glm::dvec3(1.0), shininess, {0, 0, 1}, view,
                                            {0, 0, 1})
                       .r *
                   std::cos(angle) * std::sin(angle) * 2.0 * M_PI * (M_PI / 2.0 / steps);
        }
        EXPECT_NEAR(sum, 1.0, 0.1) << shininess;  // the norm's own error, as its docstring says
        std::printf("Blinn-Phong %3.0f: share %.4f\n", shininess, sum);
    }
}

TEST(SdfShading, FloatAgreesWithDouble) {
    const std::uint64_t seed = 5;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    double worst = 0.0;
    int total = 0;
    for (int k = 0; k < 20000; ++k) {
        const float c = static_cast<float>(std::abs(unit(random)));
        const float eta = k % 2 ? 1.5f : 1.0f / 1.5f;
        const double exact = shading::fresnelShare(c, eta), rough = shading_float::fresnelShare(c, eta);
        total += exact == 1.0;
        if (exact == 1.0 || c < 0.01f) continue;
        // Where the transmitted cosine is near 0 its root takes half the digits.
        worst = std::max(worst, std::abs(exact - rough));
    }
    EXPECT_GT(total, 1000);
    EXPECT_LT(worst, 16.0 * std::sqrt(0x1p-24)) << "seed " << seed;
    std::printf("fresnelShare: float is off by at most %.2g\n", worst);
}

}  // namespace
}  // namespace edgewise::sdf
