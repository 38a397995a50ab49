// What two triangles have in common in a cell, against exact clipping: no sign of a difference of depths is
// missed.
#include "analytic/common_part.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "analytic/cell.h"

namespace edgewise {
namespace {

using Exact = boost::multiprecision::cpp_rational;
struct Place {
    Exact x, y;
};

double onGrid(double v) {
    return std::nearbyint(v / kGridPx) * kGridPx;
}

/// The part of a polygon where a x + b y + c >= 0.
std::vector<Place> clipped(const std::vector<Place>& polygon, const Exact& a, const Exact& b,
                           const Exact& c) {
    std::vector<Place> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Place &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const Exact dp = a * p.x + b * p.y + c, dq = a * q.x + b * q.y + c;
        if (dp >= 0) kept.push_back(p);
        if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
            const Exact share = dp / (dp - dq);
            kept.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
        }
    }
    return kept;
}

std::vector<Place> exactCommonPart(const ScreenTriangle& s, const ScreenTriangle& t, const Cell& cell) {
    std::vector<Place> part;
    for (const glm::dvec2& v : s.p_px) part.push_back({Exact(v.x), Exact(v.y)});
    const Exact rest(kBorderRestPx);
    part = clipped(part, 1, 0, -(cell.min.x + rest));
    part = clipped(part, -1, 0, cell.max.x + rest);
    part = clipped(part, 0, 1, -(cell.min.y + rest));
    part = clipped(part, 0, -1, cell.max.y + rest);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], b = t.p_px[(k + 1) % 3];
        const Exact ex = Exact(b.x) - Exact(a.x), ey = Exact(b.y) - Exact(a.y);
        part = clipped(part, -ey, ex, ey * Exact(a.x) - ex * Exact(a.y));
    }
    return part;
}

struct Random {
    std::mt19937_64 engine;
    double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(engine); }
    double sign() { return unit() < 0.5 ? -1.0 : 1.0; }
    /// Of any size between two powers of two.
    double sized(double low, double high) { return sign() * std::exp2(low + (high - low) * unit()); }
    int below(int n) { return static_cast<int>(engine() % static_cast<std::uint64_t>(n)); }
};

/// Counter-clockwise in the sense of ScreenTriangle, or with no area at all.
ScreenTriangle triangleOf(std::array<glm::dvec2, 3> p) {
    for (glm::dvec2& v : p) {
        v = glm::clamp(v, glm::dvec2(-kGuardBandPx), glm::dvec2(kGuardBandPx));
        v = {onGrid(v.x), onGrid(v.y)};
    }
    const Exact area = (Exact(p[1].x) - Exact(p[0].x)) * (Exact(p[2].y) - Exact(p[0].y)) -
                       (Exact(p[1].y) - Exact(p[0].y)) * (Exact(p[2].x) - Exact(p[0].x));
    if (area < 0) std::swap(p[1], p[2]);
    return {p, {0, 1, 2}, 0, 0};
}

/// Its corners near the cell, or a sliver from far away on both sides that goes through it.
ScreenTriangle randomTriangle(Random& random, glm::dvec2 middle) {
    const auto near = [&] { return middle + glm::dvec2(random.sized(-8.0, 5.0), random.sized(-8.0, 5.0)); };
    if (random.below(3) != 0) return triangleOf({near(), near(), near()});
    const glm::dvec2 through = near(), way(random.sized(4.0, 19.0), random.sized(0.0, 19.0));
    const glm::dvec2 aside(random.sized(-32.0, -4.0), random.sized(-32.0, -4.0));
    return triangleOf({through + way, through - random.unit() * way, through + aside});
}

/// Another one, or one that shares a corner or an edge, or the same moved by a few steps of the grid, or one
/// with an edge that grazes.
ScreenTriangle partnerOf(const ScreenTriangle& s, Random& random, glm::dvec2 middle) {
    std::array<glm::dvec2, 3> p = randomTriangle(random, middle).p_px;
    const int kind = random.below(6);
    if (kind == 1 || kind == 2) p[0] = s.p_px[0];
    if (kind == 2) p[1] = s.p_px[1];
    if (kind == 3) {
        p = s.p_px;
        for (glm::dvec2& v : p) v += kGridPx * glm::dvec2(random.below(5) - 2, random.below(5) - 2);
        if (kind >= 4)
            for (int k = 0; k < 2; ++k)
                p[k] = s.p_px[k] + glm::dvec2(random.sized(-32.0, -8.0), random.sized(-32.0, -8.0));
    }
    return triangleOf(p);
}

Exact depthOf(const DepthPlane& p, glm::dvec2 anchor, const Exact& x, const Exact& y) {
    return Exact(p.dz_dx) * (x - Exact(anchor.x)) + Exact(p.dz_dy) * (y - Exact(anchor.y)) +
           Exact(p.z_anchor);
}

/// Two planes that are as good as equal at a place: a corner of the common part, or beside it.
void crossAt(ScreenScene& scene, glm::dvec2 place, Random& random) {
    const DepthPlane q{random.sized(-20.0, 4.0), random.sized(-20.0, 4.0), random.unit()};
    DepthPlane p{q.dz_dx + random.sized(-20.0, 4.0), q.dz_dy + random.sized(-20.0, 4.0), 0.0};
    const Exact gap = depthOf(q, scene.anchor_px, Exact(place.x), Exact(place.y)) -
                      depthOf(p, scene.anchor_px, Exact(place.x), Exact(place.y));
    p.z_anchor = static_cast<double>(gap);
    for (int n = random.below(5); n > 0; --n) p.z_anchor = std::nextafter(p.z_anchor, random.sign() * 1e300);
    scene.planes = {p, q};
}

TEST(CommonPart, NoSignIsMissed) {
    const std::uint64_t seed = 20261128;
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    Random random{std::mt19937_64(seed)};
    int parts = 0, told_apart = 0, one_corner = 0, far_slivers = 0;
    for (int n = 0; n < 8000; ++n) {
        Cell cell;
        cell.min = 16.0 * glm::dvec2(random.below(64) * (random.below(8) == 0 ? 900 : 1), random.below(64));
        cell.max = cell.min + std::exp2(random.below(9) - 4);
        const glm::dvec2 middle = 0.5 * (cell.min + cell.max);
        ScreenTriangle s = randomTriangle(random, middle), t = partnerOf(s, random, middle);
        const std::vector<Place> exact = exactCommonPart(s, t, cell);
        if (exact.empty()) continue;
        ++parts;

        ScreenScene scene;
        scene.anchor_px = {512.0, 384.0};
        const Place& at = exact[static_cast<std::size_t>(random.below(static_cast<int>(exact.size())))];
        glm::dvec2 place(static_cast<double>(at.x), static_cast<double>(at.y));
        if (n % 2 == 0) place += glm::dvec2(random.sized(-30.0, 4.0), random.sized(-30.0, 4.0));
        crossAt(scene, place, random);
        t.plane = 1, t.owner = 1;
        const glm::dvec2 origin = cell.min, lo(0.0), hi = cell.max - origin + 2.0 * kBorderRestPx;
        const double reach = cell.max.x - origin.x + 1.0;
        const LocalPlane p = localPlane(scene, s, origin, reach), q = localPlane(scene, t, origin, reach);
        const int signs = f64::signsOver(f64::commonPart(s, t, origin, lo, hi), p, q);

        int above = 0, below = 0;
        for (const Place& v : exact) {
            const Exact d = depthOf(scene.planes[0], scene.anchor_px, v.x, v.y) -
                            depthOf(scene.planes[1], scene.anchor_px, v.x, v.y);
            above += d > 0, below += d < 0;
        }
        ASSERT_TRUE(above == 0 || (signs & 1) != 0) << "case " << n;
        ASSERT_TRUE(below == 0 || (signs & 2) != 0) << "case " << n;
        told_apart += signs != 3;
        one_corner += std::min(above, below) == 1;
        far_slivers += glm::length(s.p_px[1] - s.p_px[0]) > 4096.0;
    }
    std::printf("%d common parts, %d cut by one corner, %d of slivers longer than 4096 px, %d of one sign\n",
                parts, one_corner, far_slivers, told_apart);
    EXPECT_GT(parts, 2000);
    EXPECT_GT(one_corner, 500);
    EXPECT_GT(far_slivers, 100);
    EXPECT_GT(told_apart, 100);  // else no depth line is ever spared
}

}  // namespace
}  // namespace edgewise
