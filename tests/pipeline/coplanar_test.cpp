#include "pipeline/coplanar.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <chrono>
#include <cmath>
#include <random>

#include "tests/pipeline/test_scene.h"

namespace edgewise {
namespace {

using boost::multiprecision::cpp_rational;
using test::Corners;
using Exact = std::array<cpp_rational, 3>;

Exact exact(const glm::vec3& p) {
    return {cpp_rational(p.x), cpp_rational(p.y), cpp_rational(p.z)};
}

Exact exactNormal(const Corners& t) {
    const Exact a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
    Exact u, v, n;
    for (int k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
    for (int k = 0; k < 3; ++k) n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    return n;
}

bool exactlyCoplanar(const Corners& s, const Corners& t) {
    const Exact n = exactNormal(s), a = exact(s[0]);
    for (const glm::vec3& corner : t) {
        const Exact p = exact(corner);
        if (n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2]) != 0) return false;
    }
    return true;
}

bool hasNoArea(const Corners& t) {
    const Exact n = exactNormal(t);
    return n[0] == 0 && n[1] == 0 && n[2] == 0;
}

std::vector<Corners> latticeTriangles(std::mt19937& random, int count, int reach, float scale) {
    std::uniform_int_distribution<int> coordinate(-reach, reach);
    std::vector<Corners> triangles(count);
    for (Corners& t : triangles)
        for (glm::vec3& p : t)
            p = glm::vec3(coordinate(random), coordinate(random), coordinate(random)) * scale;
    return triangles;
}

TEST(Coplanar, GroupsMatchExactRationals) {
    std::mt19937 random(7);
    std::size_t together = 0, no_area = 0;
    for (const float scale : {1.0f, 0x1p-149f, 0x1p100f, 0x1p-60f}) {
        const auto triangles = latticeTriangles(random, 120, 1, scale);
        const auto groups = findCoplanar(test::makeScene({test::makeGeometry(triangles)}));
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            ASSERT_EQ(groups.plane_of[i] == kNone, hasNoArea(triangles[i]));
            no_area += groups.plane_of[i] == kNone;
            for (std::size_t j = 0; j < i; ++j) {
                if (groups.plane_of[i] == kNone || groups.plane_of[j] == kNone) continue;
                const bool same = exactlyCoplanar(triangles[i], triangles[j]);
                ASSERT_EQ(groups.plane_of[i] == groups.plane_of[j], same)
                    << i << " " << j << " scale " << scale;
                together += same;
            }
        }
    }
    std::printf("seed 7: %zu coplanar pairs, %zu triangles without area\n", together, no_area);
    EXPECT_GT(together, 100u);
    EXPECT_GT(no_area, 5u);
}

TEST(Coplanar, OneUlpSeparatesPlanes) {
    // Exactly one plane, far from the origin and tilted; then one corner moves by one unit in the last place.
    const glm::vec3 o(1000.0f, -37.0f, 5.0f), u(3.0f, 1.0f, -2.0f), v(-1.0f, 4.0f, 7.0f);
    std::vector<Corners> quad{{o, o + u, o + u + v}, {o, o + u + v, o + v}, {o + v, o + v + v, o - u}};
    EXPECT_EQ(findCoplanar(test::makeScene({test::makeGeometry(quad)})).planes.size(), 1u);
    quad[1][2].y = std::nextafter(quad[1][2].y, 1e9f);
    const auto groups = findCoplanar(test::makeScene({test::makeGeometry(quad)}));
    EXPECT_EQ(groups.planes.size(), 2u);
    EXPECT_EQ(groups.plane_of[0], groups.plane_of[2]);
}

TEST(Coplanar, NodesAndWindings) {
    const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
    const std::vector<Corners> square{{a, b, c}, {a, d, c}};
    const auto groups =
        findCoplanar(test::makeScene({test::makeGeometry(square), test::makeGeometry(square)}));
    EXPECT_EQ(groups.plane_of, (std::vector<std::uint32_t>{0, 0, 1, 1}));
    EXPECT_EQ(groups.reversed, (std::vector<std::uint8_t>{0, 1, 0, 1}));
}

/// Relative error of each component of a plane's normal against exact arithmetic.
TEST(Coplanar, NormalsOfSliversAreDoubleDouble) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> spread(-1000.0f, 1000.0f);
    double worst = 0.0;
    std::size_t slivers = 0;
    for (int i = 0; i < 300; ++i) {
        // Exponents far apart, so that the exact normal is longer than a double-double.
        const glm::vec3 scale(1.0f, std::ldexp(1.0f, i % 60 - 30), std::ldexp(1.0f, i % 37 - 18));
        const glm::vec3 a = scale * glm::vec3(spread(random), spread(random), spread(random));
        const glm::vec3 b = a + scale * glm::vec3(spread(random), 1, 2);
        glm::vec3 c = (a + b) * 0.5f;
        c[i % 3] = std::nextafter(c[i % 3], 1e9f);
        if (i % 4 == 0) c = glm::vec3(spread(random), 0x1p-80f * spread(random), 0x1p-90f * spread(random));
        const Corners t{a, b, c};
        const Geometry geometry = test::makeGeometry({t});
        if (findCoplanar(test::makeScene({geometry})).planes.empty()) continue;
        const auto normal = fileNormal(geometry, 0);
        const Exact n = exactNormal(t);
        for (int k = 0; k < 3; ++k) {
            const f64::dd got = normal[k];
            const cpp_rational error = cpp_rational(got.hi) + cpp_rational(got.lo) - n[k];
            if (n[k] == 0)
                EXPECT_EQ(got.hi, 0.0);
            else
                worst = std::max(worst, std::fabs(static_cast<double>(cpp_rational(error / n[k]))));
        }
        slivers += i % 4 != 0;
    }
    std::printf("seed 11: %zu slivers, worst relative error 2^%.1f\n", slivers, std::log2(worst));
    EXPECT_GT(slivers, 150u);
    EXPECT_GT(worst, 0.0);       // it met normals that do not fit
    EXPECT_LE(worst, 0x1p-104);  // what fileNormal() promises
}

TEST(Coplanar, MillionTriangles) {
    std::mt19937 random(3);
    std::vector<Corners> triangles = latticeTriangles(random, 500000, 1 << 20, 0x1p-10f);
    for (int i = 0; i < 250000; ++i) {  // flat quads among them
        const glm::vec3 o = triangles[i][0], u(i % 7 + 1, i % 5, 1), v(-2, i % 3, i % 11);
        triangles.push_back({o, o + u, o + u + v});
        triangles.push_back({o, o + u + v, o + v});
    }
    const Scene scene = test::makeScene({test::makeGeometry(triangles)});
    const auto begin = std::chrono::steady_clock::now();
    const auto groups = findCoplanar(scene);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    std::printf("%zu triangles, %zu planes, %.3f s\n", triangles.size(), groups.planes.size(),
                seconds.count());
    EXPECT_LE(groups.planes.size(), 750000u);
}

}  // namespace
}  // namespace edgewise
