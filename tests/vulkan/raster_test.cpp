// Owners at samples as the device rasterizes them, against the CPU's exact ones.
#include "pipeline/vulkan/raster.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/grid_orientation.h"
#include "pipeline/methods/point_samples.h"
#include "pipeline/project.h"
#include "tests/pipeline/shipped_picture.h"
#include "tests/pipeline/standard_locations.h"
#include "tests/vulkan/test_device.h"
#include "tests/witness/dice.h"

namespace edgewise::vulkan {
namespace {

using RasterTest = test::DeviceTest;

std::vector<Owner> onDevice(const ScreenScene& scene, const SamplePattern& pattern, RasterForm form,
                            const PixelBox& window) {
    const Device& device = test::device();
    Raster raster(device, scene, pattern, form);
    PassGraph graph(device);
    const Buffer triangles = bufferOf(device, "triangles", scene.triangles),
                 planes = bufferOf(device, "planes", scene.planes);
    const Resource owners =
        raster.addTo(graph, graph.input("triangles", triangles), graph.input("planes", planes), window);
    graph.run({owners});
    const auto found = graph[owners].read<Owner>(static_cast<std::size_t>(window.width()) * window.height() *
                                                 pattern.size());
    return {found.begin(), found.end()};
}

std::vector<Owner> exactly(const ScreenScene& scene, const SamplePattern& pattern, const PixelBox& window) {
    if (pattern.lattice) return PointSampler(scene, window, pattern.columns).sample(window).owner;
    const PointSampler sampler(scene, window, 1);
    std::vector<Owner> all(static_cast<std::size_t>(window.width()) * window.height() * pattern.size());
    for (int s = 0; s < pattern.size(); ++s) {
        const auto pass = sampler.sample(window, pattern.at_px[s] - 0.5).owner;
        for (std::size_t i = 0; i < pass.size(); ++i) all[i * pattern.size() + s] = pass[i];
    }
    return all;
}

glm::dvec2 positionOf(const SamplePattern& pattern, const PixelBox& window, std::size_t i) {
    const std::size_t stride = static_cast<std::size_t>(window.width()) * pattern.columns;
    const int column = static_cast<int>(i % stride), row = static_cast<int>(i / stride);
    return glm::dvec2(window.x0 + column / pattern.columns, window.y0 + row / pattern.rows) +
           pattern.at_px[row % pattern.rows * pattern.columns + column % pattern.columns];
}

std::vector<RasterForm> formsOf(const SamplePattern& pattern) {
    if (pattern.lattice) return {RasterForm::kLattice};
    std::vector<RasterForm> forms{RasterForm::kShifted};
    if (rasterFormFor(pattern, test::device().traits()) == RasterForm::kMultisampled)
        forms.push_back(RasterForm::kMultisampled);
    return forms;
}

std::vector<SamplePattern> allPatterns() {
    std::vector<SamplePattern> patterns;
    for (const int per_side : {1, 2, 4, 5}) patterns.push_back(latticePattern(per_side));
    for (const auto& [samples, at] : edgewise::test::standardLocations())
        patterns.push_back(standardPattern(samples));
    return patterns;
}

void addTriangle(ScreenScene& scene, std::array<glm::dvec2, 3> p, const DepthPlane& plane) {
    const int side = gridOrientation(p[0], p[1], p[2]);
    if (side == 0) return;
    if (side < 0) std::swap(p[1], p[2]);
    const auto n = static_cast<std::uint32_t>(scene.triangles.size());
    scene.triangles.push_back({p, {3 * n, 3 * n + 1, 3 * n + 2}, n, n});
    scene.planes.push_back(plane);
}

/// What lies on the far side of a border along one axis of the screen.
ScreenScene halfPlane(int axis, double border_px) {
    std::array<glm::dvec2, 3> p{glm::dvec2(border_px, -100.0), {border_px, 300.0}, {400.0, 100.0}};
    if (axis == 1)
        for (glm::dvec2& q : p) std::swap(q.x, q.y);
    ScreenScene scene;
    addTriangle(scene, p, {0.0, 0.0, 1.0});
    return scene;
}

/// Where the device's samples are: a border steps over a pixel in sixteenths, halfway between the locations.
TEST_F(RasterTest, SamplesLieAtTheSpecificationsLocations) {
    constexpr int kPixel = 3;
    const PixelBox window{0, 0, 8, 8};
    std::size_t forms = 0;
    for (const auto& [samples, expected] : edgewise::test::standardLocations()) {
        const SamplePattern pattern = standardPattern(samples);
        for (const RasterForm form : formsOf(pattern)) {
            ++forms;
            std::vector<glm::dvec2> measured(samples, glm::dvec2(0.0));
            for (int axis = 0; axis < 2; ++axis)
                for (int step = 0; step < 16; ++step) {
                    const ScreenScene scene = halfPlane(axis, kPixel + (step + 0.5) / 16);
                    const auto owners = onDevice(scene, pattern, form, window);
                    const std::size_t pixel = kPixel * window.width() + kPixel;
                    for (int s = 0; s < samples; ++s)
                        measured[s][axis] += owners[pixel * samples + s] == 0u ? 1.0 / 16 : 0.0;
                }
            EXPECT_EQ(measured, expected) << samples << " " << describe(form, pattern);
        }
    }
    EXPECT_EQ(test::device().traits().standard_samples & 4u, 4u) << "4 samples were not tried in hardware";
    fmt::print("{} forms measured\n", forms);
}

/// Corners that no snapping moves, depths that no rounding confuses.
ScreenScene snappedScene(const SamplePattern& pattern, witness::Dice& dice) {
    // Coarse, so that edges meet samples.
    const double step = pattern.lattice ? 1.0 / (2 * pattern.columns) : 1.0 / 16;
    ScreenScene scene;
    for (int i = 0; i < 60; ++i) {
        const auto corner = [&] {
            return glm::dvec2(dice.integer(-10, 60), dice.integer(-12, 50)) +
                   step * glm::dvec2(dice.integer(0, 31), dice.integer(0, 31));
        };
        addTriangle(scene, {corner(), corner(), corner()}, {0.0, 0.0, 1.0 + dice.integer(0, 1 << 16)});
    }
    return scene;
}

bool isOnEdge(const ScreenTriangle& t, glm::dvec2 p) {
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], ab = t.p_px[(k + 1) % 3] - a;
        const double along = glm::dot(p - a, ab);
        if (gridOrientation(a, a + ab, p) == 0 && along >= 0.0 && along <= glm::dot(ab, ab)) return true;
    }
    return false;
}

/// Every sample agrees, those on edges too: the rule of this device is the CPU's, top and left.
TEST_F(RasterTest, SnappedCornersGiveTheOwnersOfTheCpu) {
    constexpr std::uint64_t kSeed = 11;
    witness::Dice dice(kSeed);
    const PixelBox window{2, -3, 50, 39};
    std::size_t samples = 0, on_edges = 0, differing = 0, covered = 0;
    for (int round = 0; round < 4; ++round)
        for (const SamplePattern& pattern : allPatterns()) {
            if (pattern.lattice && pattern.columns == 5) continue;  // its samples are rounded to the grid
            const ScreenScene scene = snappedScene(pattern, dice);
            const auto expected = exactly(scene, pattern, window);
            for (const RasterForm form : formsOf(pattern)) {
                const auto got = onDevice(scene, pattern, form, window);
                for (std::size_t i = 0; i < got.size(); ++i) {
                    const glm::dvec2 at = positionOf(pattern, window, i);
                    const bool edge =
                        std::ranges::any_of(scene.triangles, [&](const auto& t) { return isOnEdge(t, at); });
                    on_edges += edge, covered += expected[i] != kBackground, ++samples;
                    if (got[i] != expected[i] && differing++ < 5)
                        ADD_FAILURE() << describe(form, pattern) << " at " << at.x << ", " << at.y << ": "
                                      << got[i] << ", not " << expected[i] << (edge ? " (on an edge)" : "");
                }
            }
        }
    fmt::print("seed {}: {} samples, {} on edges, {} covered, {} differ\n", kSeed, samples, on_edges, covered,
               differing);
    EXPECT_EQ(differing, 0u);
    EXPECT_GT(on_edges, 1000u);
    EXPECT_GT(covered, samples / 2);
    EXPECT_LT(covered, samples);
}

double distanceToEdges(const ScreenTriangle& t, glm::dvec2 p) {
    double least = HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], ab = t.p_px[(k + 1) % 3] - a;
        const double along = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
        least = std::min(least, glm::length(p - (a + along * ab)));
    }
    return least;
}

/// How far an edge may move: a corner half a subpixel along each axis, and as much again for the floats of
/// its place on the target (raster.cpp).
double reachOf(const SamplePattern& pattern) {
    const double subpixel = std::ldexp(1.0, -static_cast<int>(test::device().traits().subpixel_bits));
    return std::sqrt(2.0) * subpixel / (pattern.lattice ? pattern.columns : 1);
}

struct Differences {
    std::size_t samples = 0, differing = 0, at_edges = 0, by_depth = 0, unexplained = 0;
};

double depthAt(const ScreenScene& scene, const ScreenTriangle& t, glm::dvec2 p) {
    const DepthPlane& plane = scene.planes[t.plane];
    const glm::dvec2 d = p - scene.anchor_px;
    return plane.dz_dx * d.x + (plane.dz_dy * d.y + plane.z_anchor);
}

/// What the device may get wrong of a triangle's depth at a point of it: corners moved by `reach` under the
/// depths that they keep; and gradients in floats, z0 + dz/dx dx + dz/dy dy, whose products are of size
/// z L^2/area, 16 roundings of 2^-24 each.
double depthErrorOf(const ScreenScene& scene, const ScreenTriangle& t, double reach) {
    const DepthPlane& plane = scene.planes[t.plane];
    double most = 0.0, longest = 0.0;
    for (int k = 0; k < 3; ++k) {
        most = std::max(most, std::abs(depthAt(scene, t, t.p_px[k])));
        longest = std::max(longest, glm::length(t.p_px[(k + 1) % 3] - t.p_px[k]));
    }
    const glm::dvec2 u = t.p_px[1] - t.p_px[0], v = t.p_px[2] - t.p_px[0];
    const double area = std::abs(u.x * v.y - u.y * v.x), slope = std::hypot(plane.dz_dx, plane.dz_dy);
    const double spread = longest * longest / area;
    return spread * (2.0 * reach * slope + 16 * 0x1p-24 * most);
}

bool depthsAreClose(const ScreenScene& scene, const ScreenPieces& pieces, Owner a, Owner b, glm::dvec2 p,
                    double reach) {
    if (a == kBackground || b == kBackground) return false;
    for (const ScreenTriangle& s : pieces.of(a, scene))
        for (const ScreenTriangle& t : pieces.of(b, scene))
            if (std::abs(depthAt(scene, s, p) - depthAt(scene, t, p)) <=
                depthErrorOf(scene, s, reach) + depthErrorOf(scene, t, reach))
                return true;
    return false;
}

bool isNearEdge(const ScreenScene& scene, const ScreenPieces& pieces, Owner owner, glm::dvec2 p,
                double reach) {
    if (owner == kBackground) return false;
    for (const ScreenTriangle& t : pieces.of(owner, scene))
        if (distanceToEdges(t, p) <= reach) return true;
    return false;
}

Differences compare(const ScreenScene& scene, const ScreenPieces& pieces, const SamplePattern& pattern,
                    RasterForm form, const PixelBox& window) {
    const auto expected = exactly(scene, pattern, window), got = onDevice(scene, pattern, form, window);
    const double reach = reachOf(pattern);
    Differences out;
    for (std::size_t i = 0; i < got.size(); ++i) {
        ++out.samples;
        if (got[i] == expected[i]) continue;
        ++out.differing;
        const glm::dvec2 p = positionOf(pattern, window, i);
        if (isNearEdge(scene, pieces, got[i], p, reach) || isNearEdge(scene, pieces, expected[i], p, reach))
            ++out.at_edges;
        else if (depthsAreClose(scene, pieces, got[i], expected[i], p, reach))
            ++out.by_depth;
        else if (out.unexplained++ < 3)
            ADD_FAILURE() << describe(form, pattern) << " at " << p.x << ", " << p.y << ": " << got[i]
                          << ", not " << expected[i];
    }
    return out;
}

/// Any corners at all, many far beyond the window, where the guard band's cut must not show.
TEST_F(RasterTest, AnyCornersDifferAtEdgesAlone) {
    constexpr std::uint64_t kSeed = 12;
    witness::Dice dice(kSeed);
    const PixelBox window{-5, 8, 59, 60};
    std::size_t far = 0;
    Differences all;
    for (int round = 0; round < 8; ++round) {
        ScreenScene scene;
        for (int i = 0; i < 50; ++i) {
            const auto corner = [&] {
                const double radius = dice.coin() ? 80.0 : std::pow(2.0, dice.uniform(6.0, 20.0));
                far += radius > 2000.0;
                return glm::round(glm::clamp(dice.around({30.0, 30.0}, radius), -kGuardBandPx, kGuardBandPx) /
                                  kGridPx) *
                       kGridPx;
            };
            addTriangle(scene, {corner(), corner(), corner()}, {0.0, 0.0, 1.0 + dice.integer(0, 1 << 16)});
        }
        ScreenPieces pieces;
        for (std::uint32_t i = 0; i <= scene.triangles.size(); ++i) pieces.first.push_back(i);
        for (const SamplePattern& pattern : allPatterns())
            for (const RasterForm form : formsOf(pattern)) {
                const Differences one = compare(scene, pieces, pattern, form, window);
                EXPECT_EQ(one.by_depth, 0u);
                all.samples += one.samples, all.differing += one.differing;
            }
    }
    fmt::print(
        "seed {}: {} corners beyond 2000 px; {} of {} samples differ, all within a subpixel's diagonal "
        "of an edge\n",
        kSeed, far, all.differing, all.samples);
    EXPECT_GT(far, 100u);
}

/// The device's own precision on the scenes that ship: which fraction of the samples it sees otherwise, and
/// that each lies beside an edge, or between depths that a float does not tell apart.
TEST_F(RasterTest, ShippedScenesDifferAtEdgesAndCloseDepthsAlone) {
    for (const scenes::Recipe& recipe : edgewise::test::shippedRecipes()) {
        const auto picture = edgewise::test::shippedPicture(recipe, 256);
        ScreenPieces pieces;
        const ScreenScene screen = project(picture.scene, picture.camera, picture.film, pieces);
        if (!screen.see_through.empty()) continue;
        for (const SamplePattern& pattern : {latticePattern(1), latticePattern(4), standardPattern(4)})
            for (const RasterForm form : formsOf(pattern)) {
                const Differences d = compare(screen, pieces, pattern, form, picture.film.crop);
                fmt::print("{:28} {:26} {:8} samples, {:8.2e} differ: {} at edges, {} by depth\n",
                           picture.name, describe(form, pattern), d.samples,
                           double(d.differing) / double(d.samples), d.at_edges, d.by_depth);
            }
    }
}

}  // namespace
}  // namespace edgewise::vulkan
