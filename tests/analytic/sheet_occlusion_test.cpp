// What a sheet hides: never anything that is seen at some point of the cell, and all of a sheet well behind.
#include "analytic/sheet_occlusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analytic/cell_visibility.h"

namespace edgewise {
namespace {

const Cell kCell{{16.0, 32.0}, {32.0, 48.0}};

/// A grid of triangles over the cell and some way beyond, its depth given at its vertices.
class Sheets {
  public:
    template <class Depth>
    std::vector<std::uint32_t> add(double step_px, glm::dvec2 shift_px, const Depth& depth) {
        const int n = static_cast<int>(32.0 / step_px) + 2;
        const auto first_vertex = next_vertex_;
        next_vertex_ += static_cast<std::uint32_t>((n + 1) * (n + 1));
        const auto id = [&](glm::ivec2 v) {
            return first_vertex + static_cast<std::uint32_t>(v.y * (n + 1) + v.x);
        };
        const auto at = [&](glm::ivec2 v) {
            return glm::dvec2(7.0, 23.0) + shift_px + step_px * glm::dvec2(v);
        };
        std::vector<std::uint32_t> added;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                for (const std::array<glm::ivec2, 3>& corners :
                     {std::array<glm::ivec2, 3>{{{x, y}, {x + 1, y}, {x + 1, y + 1}}},
                      std::array<glm::ivec2, 3>{{{x, y}, {x + 1, y + 1}, {x, y + 1}}}}) {
                    ScreenTriangle t;
                    std::array<double, 3> z{};
                    for (int k = 0; k < 3; ++k) {
                        t.p_px[k] = at(corners[k]), t.vertex[k] = id(corners[k]);
                        z[k] = depth(t.p_px[k]);
                    }
                    t.owner = t.plane = static_cast<std::uint32_t>(scene.triangles.size());
                    scene.planes.push_back(planeThrough(t, z));
                    added.push_back(static_cast<std::uint32_t>(scene.triangles.size()));
                    scene.triangles.push_back(t);
                }
        return added;
    }

    std::vector<std::uint8_t> hidden(const std::vector<std::uint32_t>& list) const {
        SharedEdges shared;
        shared.collect(scene, kCell, list);
        SheetOcclusion occlusion;
        const auto found = occlusion.hidden(scene, kCell, list, shared);
        return {found.begin(), found.end()};
    }

    double depthOf(std::uint32_t triangle, glm::dvec2 p) const {
        const DepthPlane& plane = scene.planes[triangle];
        return plane.dz_dx * p.x + plane.dz_dy * p.y + plane.z_anchor;
    }

    ScreenScene scene;

  private:
    static DepthPlane planeThrough(const ScreenTriangle& t, const std::array<double, 3>& z) {
        const glm::dvec2 u = t.p_px[1] - t.p_px[0], v = t.p_px[2] - t.p_px[0];
        const double area = u.x * v.y - u.y * v.x, du = z[1] - z[0], dv = z[2] - z[0];
        DepthPlane plane;
        plane.dz_dx = (du * v.y - dv * u.y) / area;
        plane.dz_dy = (dv * u.x - du * v.x) / area;
        plane.z_anchor = z[0] - plane.dz_dx * t.p_px[0].x - plane.dz_dy * t.p_px[0].y;
        return plane;
    }

    std::uint32_t next_vertex_ = 0;
};

std::vector<std::uint32_t> meeting(const Sheets& sheets) {
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < sheets.scene.triangles.size(); ++i)
        if (overlap(sheets.scene.triangles[i], kCell).meets) list.push_back(i);
    return list;
}

TEST(SheetOcclusion, ASheetHidesWhatLiesBehindIt) {
    Sheets sheets;
    const auto rear = sheets.add(3.0, {0.0, 0.0}, [](glm::dvec2) { return 1.0; });
    sheets.add(2.5, {0.3, 0.1}, [](glm::dvec2) { return 2.0; });
    const auto list = meeting(sheets);
    const auto hidden = sheets.hidden(list);
    ASSERT_EQ(hidden.size(), list.size());
    for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ(hidden[i], list[i] < rear.size()) << list[i];
}

TEST(SheetOcclusion, ASheetWithAHoleHidesNothing) {
    Sheets sheets;
    sheets.add(3.0, {0.0, 0.0}, [](glm::dvec2) { return 1.0; });
    const auto front = sheets.add(2.5, {0.3, 0.1}, [](glm::dvec2) { return 2.0; });
    auto list = meeting(sheets);
    const auto middle = std::ranges::find_if(list, [&](std::uint32_t i) {
        return i >= front.front() && sideOfTriangle(sheets.scene.triangles[i], {24.1, 40.2}) > 0;
    });
    ASSERT_NE(middle, list.end());
    list.erase(middle);
    // The rear sheet covers the cell, but hides nothing of the front one.
    EXPECT_EQ(std::ranges::count(sheets.hidden(list), 1), 0);
}

TEST(SheetOcclusion, NothingThatIsSeenIsHidden) {
    const unsigned seed = 20261128;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int dropped = 0, kept_behind = 0;
    for (int round = 0; round < 200; ++round) {
        Sheets sheets;
        for (int sheet = 0; sheet < 3; ++sheet) {
            const double level = unit(random) * 3.0, tilt = unit(random) * 0.2, wave = unit(random) * 0.5,
                         phase = 6.0 * unit(random);
            sheets.add(1.5 + 4.0 * unit(random), {unit(random), unit(random)}, [&](glm::dvec2 p) {
                return level + tilt * (p.x - 24.0) + wave * std::sin(0.4 * p.x + 0.3 * p.y + phase);
            });
        }
        auto list = meeting(sheets);
        if (round % 4 == 0)
            list.erase(list.begin() + static_cast<std::ptrdiff_t>(unit(random) * list.size()));
        const auto hidden = sheets.hidden(list);
        if (hidden.empty()) continue;
        for (int sample = 0; sample < 400; ++sample) {
            const glm::dvec2 p = kCell.min + (kCell.max - kCell.min) * glm::dvec2(unit(random), unit(random));
            double nearest = -HUGE_VAL;
            std::size_t seen = list.size();
            for (std::size_t i = 0; i < list.size(); ++i) {
                if (sideOfTriangle(sheets.scene.triangles[list[i]], p) <= 0) continue;
                const double z = sheets.depthOf(list[i], p);
                kept_behind += hidden[i] == 0 && z < nearest;
                if (z > nearest) nearest = z, seen = i;
            }
            if (seen == list.size()) continue;
            ASSERT_EQ(hidden[seen], 0) << "seed " << seed << " round " << round;
        }
        dropped += static_cast<int>(std::ranges::count(hidden, 1));
    }
    EXPECT_GT(dropped, 1000);
    EXPECT_GT(kept_behind, 1000) << "some sheets pierce each other";
}

}  // namespace
}  // namespace edgewise
