#include "paper_figures/stage_ideals.h"

#include <algorithm>

#include "analytic/edge_integral.h"
#include "analytic/pixel_weights.h"
#include "analytic/screen_triangle.h"
#include "analytic/visible_segment.h"
#include "pipeline/shade.h"

namespace edgewise::figures {
namespace {

constexpr double kCorners = sizeof(ScreenTriangle::p_px);
constexpr double kId = sizeof(std::uint32_t);
/// A division counts as one, an exponential by a polynomial of degree 11 as 24 with its reduction.
constexpr double kExponentialFlops = 24, kNodeFlops = 6;
constexpr double kBoxFlops =
    5 + 2 * 4;  ///< [E1] and two clip points of a multiplication and addition an axis

double medianOf(const compare::Row& row, const std::string& stage) {
    const auto found = row.stages.find(stage);
    return found == row.stages.end() ? 0.0 : compare::spreadOf(found->second).median;
}

double countOf(const compare::Row& row, const std::string& name) {
    if (name == "pixels") return static_cast<double>(row.size.x) * row.size.y;
    const auto found = row.counts.find(name);
    return found == row.counts.end() ? 0.0 : static_cast<double>(found->second);
}

}  // namespace

double flopsPerTerm(const std::string& filter, double radius) {
    if (filter != "gaussian") return kBoxFlops;
    const EdgeKernel kernel(makePrefilter(filter, radius, {}));
    return kBoxFlops + kernel.piece_rules.front().count() * (kExponentialFlops + kNodeFlops);
}

std::vector<StageModel> stageModels(const std::string& filter, double radius) {
    return {
        {"project",
         {{"triangles", 3 * (sizeof(glm::dvec3) + kId), 3 * 24,
           "three corners and their indices read; each corner through an affine map (18) and a perspective "
           "division with scale and offset (6)"},
          {"screen_triangles", sizeof(ScreenTriangle) + sizeof(DepthPlane), 14,
           "a triangle and its depth plane written; two differences of depth over a determinant"}}},
        {"plan",
         {{"triangles", sizeof(std::optional<Shade>), 0,
           "the shade of a triangle whose colour is constant"}}},
        {"gather",
         {{"screen_triangles", 2 * kCorners, 2 * 8,
           "corners read twice, to count and to fill; a box by minima and maxima"},
          {"cell_triangle_pairs", 2 * kId, 0, "an id written, a counter raised"},
          {"segments", 2 * sizeof(VisibleSegment::a), 0, "ends read, for the tiles of weights"}}},
        {"visibility",
         {{"cell_triangle_pairs", kId + sizeof(ScreenTriangle) + sizeof(DepthPlane), 3 * (5 + 3),
           "a triangle and its plane read; three edge functions at a cell's corner (5), and from there to "
           "the "
           "other three (1 each)"},
          {"slabs", 0, 8, "where two lines lie on either side of a slab"},
          {"segments", sizeof(VisibleSegment), 12, "a segment written; its ends, two lines' intersections"}}},
        {"weights",
         {{"terms", 0, flopsPerTerm(filter, radius), "the closed form"},
          {"segments", sizeof(VisibleSegment), 0, "a segment read"},
          {"pixel_owner_pairs", sizeof(OwnerWeight), 0, "an owner and its weight written"}}},
        {"blend",
         {{"pixel_owner_pairs", sizeof(OwnerWeight), 8,
           "an owner and its weight read; weight times colour and alpha, added. Shading is not in it"},
          {"pixels", sizeof(glm::dvec4) + sizeof(float), 0, "a pixel and its edge written"}}},
    };
}

std::vector<StageDistance> stageDistances(const compare::Row& nsaa, const MachineRates& rates) {
    std::vector<StageDistance> found;
    for (const StageModel& model : stageModels(nsaa.filter, nsaa.radius)) {
        StageDistance one{model.stage, medianOf(nsaa, model.stage), 0.0, 0.0, 0.0, true};
        for (const IdealPart& part : model.parts) {
            one.bytes += part.bytes * countOf(nsaa, part.count);
            one.flops += part.flops * countOf(nsaa, part.count);
        }
        const double moved = one.bytes / rates.bytes_per_second;
        const double computed = one.flops / rates.flops_per_second;
        one.ideal_seconds = std::max(moved, computed);
        one.memory_bound = moved >= computed;
        if (one.seconds > 0.0 && one.ideal_seconds > 0.0) found.push_back(one);
    }
    return found;
}

std::vector<UnitCost> unitCosts(const compare::Row& nsaa) {
    std::vector<UnitCost> costs{
        {"project", "triangles", "triangle"},  {"gather", "cell_triangle_pairs", "cell-triangle pair"},
        {"visibility", "segments", "segment"}, {"visibility", "slabs", "slab"},
        {"weights", "terms", "term"},          {"blend", "pixel_owner_pairs", "pixel-owner pair"}};
    for (UnitCost& cost : costs) {
        cost.number = countOf(nsaa, cost.count);
        if (cost.number > 0.0) cost.nanoseconds = 1e9 * medianOf(nsaa, cost.stage) / cost.number;
    }
    return costs;
}

}  // namespace edgewise::figures
