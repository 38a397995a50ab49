#include "pipeline/brdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <random>

namespace edgewise {
namespace {

const glm::dvec3 kUp(0, 0, 1);

/// From the pole and the azimuth.
glm::dvec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

/// The Appendix's terms in long double, from angles where the code uses cosines: tan^2 forms of D and of
/// Smith's G1 = 2 / (1 + sqrt(1 + alpha^2 tan^2)).
struct Reference {
    long double alpha, base, metallic;

    static long double tan2(long double c) { return (1 - c * c) / (c * c); }
    long double g1(long double c) const { return 2 / (1 + std::sqrt(1 + alpha * alpha * tan2(c))); }
    long double d(long double c) const {
        const long double ratio = alpha * alpha + tan2(c);
        return alpha * alpha / (M_PIl * c * c * c * c * ratio * ratio);
    }
    long double operator()(const glm::dvec3& v, const glm::dvec3& l) const {
        const long double vl = glm::dot(v, l), half = std::acos(std::min(1.0L, vl)) / 2;
        const glm::tvec3<long double> sum = glm::tvec3<long double>(v) + glm::tvec3<long double>(l);
        const long double h_z = sum.z / std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z);
        const long double specular = d(h_z) * g1(v.z) * g1(l.z) / (4 * v.z * l.z);
        const long double five = std::pow(1 - std::cos(half), 5);
        const long double f = 0.04L + 0.96L * five;
        const long double dielectric = (1 - f) * base / M_PIl + f * specular;
        return (1 - metallic) * dielectric + metallic * specular * (base + (1 - base) * five);
    }
};

TEST(Brdf, AgreesWithTheAppendixWrittenInAngles) {
    std::mt19937 random(61);
    std::uniform_real_distribution<double> unit(0, 1);
    double worst = 0.0;
    std::size_t highlights = 0, grazing = 0;
    for (int i = 0; i < 20000; ++i) {
        const Reflectance surface{glm::dvec3(unit(random)), unit(random),
                                  kLeastRoughness + unit(random) * 0.9};
        const glm::dvec3 v = direction(0.01 + 0.99 * unit(random), 7 * unit(random));
        const bool mirrored = i % 2 == 0;
        const glm::dvec3 l = mirrored ? glm::normalize(glm::dvec3(-v.x, -v.y, v.z) + 0.01 * unit(random))
                                      : direction(0.01 + 0.99 * unit(random), 7 * unit(random));
        const Reference reference{surface.roughness * surface.roughness, surface.base.r, surface.metallic};
        const double expected = reference(v, l), got = brdf(surface, kUp, v, l).r;
        worst = std::max(worst, std::fabs(got - expected) / expected);
        highlights += expected > 10;
        grazing += v.z < 0.1;
    }
    std::printf("seed 61: worst relative difference %.1f u, %zu highlights\n", worst * 0x1p53, highlights);
    // 40 roundings; H errs by 4 u across N, which changes D by at most 2 / alpha <= 2^9 times that.
    EXPECT_LE(worst, (40 + 4 * 0x1p9) * 0x1p-53);
    EXPECT_GT(highlights, 500u);
    EXPECT_GT(grazing, 500u);
}

TEST(Brdf, KnownValues) {
    // Normal incidence, alpha 1: D = 1/pi, V = 1/4; alpha 1/4: D = 16/pi.
    EXPECT_NEAR(brdf({glm::dvec3(1), 0, 1}, kUp, kUp, kUp).r * M_PI, 0.96 + 0.04 / 4, 8 * 0x1p-53);
    EXPECT_NEAR(brdf({glm::dvec3(0.5), 1, 1}, kUp, kUp, kUp).r * M_PI, 0.5 / 4, 8 * 0x1p-53);
    EXPECT_NEAR(brdf({glm::dvec3(0.5), 1, 0.5}, kUp, kUp, kUp).r * M_PI, 0.5 * 16 / 4, 64 * 0x1p-53);
    EXPECT_EQ(brdf({glm::dvec3(1), 1, 0}, kUp, kUp, kUp),
              brdf({glm::dvec3(1), 1, kLeastRoughness}, kUp, kUp, kUp));
    EXPECT_TRUE(std::isfinite(brdf({glm::dvec3(1), 0, 0}, kUp, -kUp, kUp).r));
}

TEST(Brdf, IsReciprocal) {
    std::mt19937 random(62);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 5000; ++i) {
        const Reflectance surface{{unit(random), unit(random), unit(random)}, unit(random), unit(random)};
        const glm::dvec3 v = direction(unit(random), 7 * unit(random)),
                         l = direction(unit(random), 7 * unit(random));
        const glm::dvec3 forth = brdf(surface, kUp, v, l), back = brdf(surface, kUp, l, v);
        // V.H and L.H differ by 8 u, their fifth power by five times that; a dozen more roundings
        const double facets = brdf({glm::dvec3(1.0), 1.0, surface.roughness}, kUp, v, l).r;
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(forth[k], back[k], 52 * 0x1p-53 * (1 / M_PI + facets));
    }
}

/// The share of the light that leaves: int brdf(v, l) (n . l) dl, by the midpoint rule over the half vector's
/// slope for the highlight's sake: h = (s cos a, s sin a, 1) normalised, s = alpha tan(pi q / 2) spread like
/// D. dl = 4 (v . h) dh, dh = cos^3 s ds da.
glm::dvec3 furnace(const Reflectance& surface, double view_cosine) {
    constexpr int kSlopes = 400, kTurns = 200;
    const double alpha =
        std::max(surface.roughness, kLeastRoughness) * std::max(surface.roughness, kLeastRoughness);
    const glm::dvec3 v = direction(view_cosine, 0.0);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kSlopes; ++i) {
        const double q = (i + 0.5) / kSlopes, s = alpha * std::tan(M_PI_2 * q);
        const double ds = alpha * M_PI_2 / std::pow(std::cos(M_PI_2 * q), 2) / kSlopes;
        const double c = 1 / std::sqrt(1 + s * s);
        for (int j = 0; j < kTurns; ++j) {
            const glm::dvec3 h = direction(c, 2 * M_PI * (j + 0.5) / kTurns);
            const double vh = glm::dot(v, h);
            const glm::dvec3 l = 2 * vh * h - v;
            if (vh <= 0 || l.z <= 0) continue;
            sum += brdf(surface, kUp, v, l) * (l.z * 4 * vh * c * c * c * s * ds * 2 * M_PI / kTurns);
        }
    }
    return sum;
}

/// The same of the diffuse lobe alone, by the midpoint rule over (n . l)^2 and the azimuth.
double diffuseFurnace(double roughness, double view_cosine) {
    constexpr int kSteps = 200;
    const glm::dvec3 v = direction(view_cosine, 0.0);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const glm::dvec3 l = direction(std::sqrt((i + 0.5) / kSteps), 2 * M_PI * (j + 0.5) / kSteps);
            sum += brdf({glm::dvec3(1), 0, roughness}, kUp, v, l).r -
                   brdf({glm::dvec3(0), 0, roughness}, kUp, v, l).r;
        }
    return sum * M_PI / (kSteps * kSteps);
}

TEST(Brdf, NoLobeSendsBackMoreThanArrives) {
    double largest = 0.0, least = 1.0;
    for (const double roughness : {0.0, 0.2, 0.5, 1.0})
        for (const double cosine : {0.05, 0.2, 0.5, 0.9, 1.0}) {
            const double mirror = furnace({glm::dvec3(1), 1, roughness}, cosine).r;
            const double glossy = furnace({glm::dvec3(0), 0, roughness}, cosine).r;
            largest = std::max(largest, mirror);
            least = std::min(least, mirror);
            EXPECT_LE(glossy, mirror);
            EXPECT_LE(diffuseFurnace(roughness, cosine), 0.96);
            EXPECT_GT(diffuseFurnace(roughness, cosine), 0.85);
        }
    std::printf("a white metal sends back %.4f to %.4f\n", least, largest);
    EXPECT_LE(largest, 1.0 + 1e-4) << "more than the midpoint rule's own error";
    EXPECT_GT(largest, 0.99) << "a smooth mirror loses almost nothing: else the quadrature missed it";
    EXPECT_LT(least, 0.6) << "a rough one loses what its facets pass on to each other";
}

TEST(Brdf, MetallicMixesTheTwo) {
    const glm::dvec3 v = direction(0.6, 1), l = direction(0.7, 3), base(0.9, 0.5, 0.1);
    const glm::dvec3 at0 = brdf({base, 0, 0.4}, kUp, v, l), at1 = brdf({base, 1, 0.4}, kUp, v, l);
    const glm::dvec3 got = brdf({base, 0.25, 0.4}, kUp, v, l);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], 0.75 * at0[k] + 0.25 * at1[k], 4 * 0x1p-53);
}

}  // namespace
}  // namespace edgewise
