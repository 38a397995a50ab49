#include "pipeline/methods/point_samples.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <random>

#include "pipeline/grid_orientation.h"

namespace edgewise {
namespace {

using boost::multiprecision::cpp_rational;

cpp_rational crossExact(glm::dvec2 a, glm::dvec2 b, glm::dvec2 s) {
    const cpp_rational ax(a.x), ay(a.y);
    return (cpp_rational(b.x) - ax) * (cpp_rational(s.y) - ay) -
           (cpp_rational(b.y) - ay) * (cpp_rational(s.x) - ax);
}

struct Seen {
    std::size_t on_edges = 0, depth_ties = 0, covered = 0;
};

bool covers(const ScreenTriangle& t, glm::dvec2 s, Seen& seen) {
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], b = t.p_px[(k + 1) % 3];
        const cpp_rational side = crossExact(a, b, s);
        const bool top_left = b.y < a.y || (b.y == a.y && b.x > a.x);
        seen.on_edges += side == 0;
        inside = inside && (side > 0 || (side == 0 && top_left));
    }
    return inside;
}

Owner bruteForce(const ScreenScene& scene, glm::dvec2 s, Seen& seen) {
    Owner best = kBackground;
    cpp_rational best_depth;
    for (const ScreenTriangle& t : scene.triangles) {
        if (!covers(t, s, seen)) continue;
        ++seen.covered;
        const DepthPlane& p = scene.planes[t.plane];
        const cpp_rational depth =
            cpp_rational(p.dz_dx) * (cpp_rational(s.x) - cpp_rational(scene.anchor_px.x)) +
            cpp_rational(p.dz_dy) * (cpp_rational(s.y) - cpp_rational(scene.anchor_px.y)) +
            cpp_rational(p.z_anchor);
        if (best != kBackground && depth == best_depth) ++seen.depth_ties;
        if (best != kBackground && depth <= best_depth) continue;
        best = t.owner;
        best_depth = depth;
    }
    return best;
}

/// Corners on a lattice of so many steps a pixel, or (0) anywhere on the grid; planes that tie at many
/// samples.
ScreenScene randomScene(std::mt19937& random, int count, int lattice, int size) {
    std::uniform_int_distribution<int> coarse(-2 * lattice, (size + 2) * lattice), slope(-2, 2);
    std::uniform_real_distribution<double> fine(-2.0, size + 2.0);
    auto coordinate = [&] {
        return lattice ? coarse(random) / double(lattice) : std::floor(fine(random) * 0x1p32) * kGridPx;
    };
    ScreenScene scene;
    scene.anchor_px = {size / 2.0 + 0.5, size / 2.0};
    while (scene.triangles.size() < static_cast<std::size_t>(count)) {
        ScreenTriangle t{};
        for (auto& p : t.p_px) p = {coordinate(), coordinate()};
        const int side = gridOrientation(t.p_px[0], t.p_px[1], t.p_px[2]);
        if (side == 0) continue;
        if (side < 0) std::swap(t.p_px[1], t.p_px[2]);
        t.owner = static_cast<Owner>(2 * scene.triangles.size());
        t.plane = static_cast<std::uint32_t>(scene.planes.size());
        const double wobble = scene.planes.size() % 3 == 0 ? 0x1p-60 : 0.0;
        scene.planes.push_back({slope(random) / 4.0 + wobble, slope(random) / 4.0, slope(random) + 3.0});
        scene.triangles.push_back(t);
    }
    return scene;
}

void compare(const ScreenScene& scene, const PixelBox& box, const PixelBox& window, int per_side, Seen& seen,
             std::uint64_t& exact_depths) {
    const PointSampler sampler(scene, box, per_side);
    const auto owners = sampler.sample(window).owner;
    for (int y = 0; y < window.height() * per_side; ++y)
        for (int x = 0; x < window.width() * per_side; ++x) {
            const glm::dvec2 s(window.x0 + x / per_side + sampleOffsetPx(x % per_side, per_side),
                               window.y0 + y / per_side + sampleOffsetPx(y % per_side, per_side));
            ASSERT_EQ(owners[std::size_t(y) * window.width() * per_side + x], bruteForce(scene, s, seen))
                << "at " << s.x << ", " << s.y << " K " << per_side;
        }
    exact_depths += sampler.exactDepths();
}

TEST(PointSamples, MatchExactRationals) {
    std::mt19937 random(23);
    Seen seen;
    std::uint64_t exact_depths = 0;
    for (const int per_side : {1, 2, 3, 4, 7}) {
        const int size = per_side < 3 ? 12 : 5, lattice = per_side == 3 || per_side == 7 ? 8 : 2 * per_side;
        const PixelBox box{0, 0, size, size}, outer{-3, -3, size + 3, size + 3}, band{-3, 1, size + 3, 3};
        compare(randomScene(random, 30, lattice, size), box, box, per_side, seen, exact_depths);
        compare(randomScene(random, 30, 0, size), outer, band, per_side, seen, exact_depths);
    }
    std::printf("seed 23: %zu hits, %zu samples on edge lines, %zu depth ties, %llu exact depth decisions\n",
                seen.covered, seen.on_edges, seen.depth_ties, static_cast<unsigned long long>(exact_depths));
    EXPECT_GT(seen.on_edges, 200u);
    EXPECT_GT(seen.depth_ties, 100u);
    EXPECT_GT(exact_depths, 100u);
}

TEST(PointSamples, EachPointOfAFanHasOneOwner) {
    // Triangles around a vertex that is itself a sample, with edges through other samples: no gap, no
    // overlap.
    ScreenScene scene;
    scene.anchor_px = {4.0, 4.0};
    const glm::dvec2 hub(4.5, 4.5);
    const std::vector<glm::dvec2> rim{{0.5, 0.5}, {4.5, 0.5}, {8.5, 0.5}, {8.5, 4.5},
                                      {8.5, 8.5}, {1.5, 7.5}, {0.5, 4.5}};
    for (std::size_t i = 0; i < rim.size(); ++i) {
        scene.triangles.push_back({{hub, rim[i], rim[(i + 1) % rim.size()]}, {}, static_cast<Owner>(i), 0});
        ASSERT_GT(gridOrientation(hub, rim[i], rim[(i + 1) % rim.size()]), 0);
    }
    scene.planes.resize(1);
    for (int y = 1; y < 7; ++y)
        for (int x = 1; x < 8; ++x) {
            Seen seen;
            int owners = 0;
            for (const ScreenTriangle& t : scene.triangles) owners += covers(t, {x + 0.5, y + 0.5}, seen);
            ASSERT_EQ(owners, 1) << x << " " << y;
        }
    Seen seen;
    std::uint64_t exact_depths = 0;
    compare(scene, {0, 0, 9, 9}, {0, 0, 9, 9}, 1, seen, exact_depths);
    EXPECT_EQ(exact_depths, 0u);
}

TEST(PointSamples, TilesAndWindowsDoNotShow) {
    std::mt19937 random(29);
    const ScreenScene scene = randomScene(random, 300, 0, 100);
    const PixelBox all{0, 0, 100, 100}, part{13, 37, 90, 81};
    const auto whole = PointSampler(scene, all, 4).sample(all).owner;
    const auto cut = PointSampler(scene, part, 4).sample(part).owner;
    for (int y = 0; y < part.height() * 4; ++y)
        for (int x = 0; x < part.width() * 4; ++x)
            ASSERT_EQ(cut[std::size_t(y) * part.width() * 4 + x],
                      whole[std::size_t(y + part.y0 * 4) * 400 + x + part.x0 * 4]);
}

}  // namespace
}  // namespace edgewise
