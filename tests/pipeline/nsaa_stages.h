// The stages of nsaa called one after the other, for tests that look at single pixels: what their values are
// made of, and how far rounding may move them.
#pragma once

#include <cmath>

#include "pipeline/gather.h"
#include "pipeline/plan.h"
#include "pipeline/project.h"

namespace edgewise::test {

inline constexpr double kUnit = 0x1p-53;
/// Roundings of one term, each of a value below 1; the same count as in nsaa_truth_test.
inline constexpr double kTermRoundings = 10.0;
/// No colour of a scene that ships exceeds what the default rig sends back from white.
inline constexpr double kMaxColor = 1.03;

/// What one pixel is made of.
struct PixelParts {
    std::uint64_t terms = 0;
    std::uint64_t label_conflicts = 0;
    std::vector<OwnerWeight> entries;

    FixedWeight sum() const {
        FixedWeight total = 0;
        for (const OwnerWeight& entry : entries) total += entry.weight;
        return total;
    }
    double background() const {
        for (const OwnerWeight& entry : entries)
            if (entry.owner == kBackground)
                return std::ldexp(static_cast<double>(entry.weight), -kWeightBits);
        return 0.0;
    }
    /// A weight errs by each term's rounding and the fixed point's. In a colour each of n products is rounded
    /// twice (the weight to double, the product), and their sum n - 1 times: (n + 1) u of the products'
    /// sizes, to first order; one more u covers the rest.
    double colorError() const {
        double size = 0.0;
        for (const OwnerWeight& entry : entries)
            size += std::abs(std::ldexp(static_cast<double>(entry.weight), -kWeightBits));
        const double weights = static_cast<double>(terms + 1) * (kTermRoundings * kUnit + 0x1p-60);
        return kMaxColor * (weights + static_cast<double>(entries.size() + 2) * kUnit * size);
    }
};

class NsaaStages {
  public:
    explicit NsaaStages(const MethodInput& in)
        : screen_(project(in.scene, in.camera, in.film, pieces_)),
          shading_(in.scene, in.camera, in.film, screen_, pieces_),
          plan_(makePlan(in.scene, screen_, pieces_, shading_, in.options)),
          worker_(in.filter, plan_.weights) {
        const PixelBox& box = in.film.crop;
        const int reach = static_cast<int>(std::ceil(in.filter.radius)) + 1;
        const CellGrid grid(Window{box.x0 - reach, box.y0 - reach, box.x1 + reach, box.y1 + reach});
        VisibilityCounts counts;
        map_ = visibility(screen_, grid, gather(screen_, grid), plan_.visibility, in.progress, counts);
        tiles_ = gatherSegments(map_, box, glm::dvec2(0.0), in.filter.radius);
    }

    const Plan& plan() const { return plan_; }
    const ScreenScene& screen() const { return screen_; }

    PixelParts pixel(int x, int y) {
        const std::uint64_t terms = worker_.terms(), conflicts = worker_.labelConflicts();
        WeightTile tile = weigh(x, y);
        return {worker_.terms() - terms, worker_.labelConflicts() - conflicts, std::move(tile.entries)};
    }

    WeightTile weigh(int x, int y) {
        const std::size_t t = tileOf(x, y);
        const auto& lists = tiles_.segments;
        const auto ids =
            std::span(lists.ids).subspan(lists.offsets[t], lists.offsets[t + 1] - lists.offsets[t]);
        WeightTile tile;
        worker_.run(map_, ids, plan_.classes, {x, y, x + 1, y + 1}, glm::dvec2(0.0), tile);
        return tile;
    }

  private:
    std::size_t tileOf(int x, int y) const {
        std::size_t t = 0;
        while (!tiles_.boxes[t].contains(x, y)) ++t;
        return t;
    }

    ScreenPieces pieces_;
    ScreenScene screen_;
    Shading shading_;
    Plan plan_;
    WeightWorker worker_;
    VisibleMap map_;
    WeightTiles tiles_;
};

}  // namespace edgewise::test
