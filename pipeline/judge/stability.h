// The stability study: the product against the oracle over stiff and extreme scenes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analytic/precision.h"
#include "analytic/prefilter.h"
#include "pipeline/judge/map_comparison.h"
#include "pipeline/judge/projection_witness.h"
#include "pipeline/progress.h"

namespace edgewise::judge {

/// What weights of one precision come to.
struct WeightErrors {
    double max_error = 0.0;  ///< of a weight
    /// In units in the last place that the exact weight has in this precision, where it is 2^-30 or more.
    double max_error_ulp = 0.0;
    double max_relative = 0.0;    ///< the same, relative
    double bound = 0.0;           ///< promised for the scene of the largest error: see promisedBound()
    double worst_of_bound = 0.0;  ///< the largest ratio of an error to its scene's bound
    /// Owners that one sees with 2^-50 or more (fp32: 64 * 2^-24) and the other not at all.
    std::size_t ownership_errors = 0;
    double partition_defect = 0.0;  ///< |sum of weights - 1|, in the fixed point
    std::uint64_t label_conflicts = 0;
    double seconds = 0.0;  ///< the product's, a pixel: the map and its weights
};

/// What one difficulty of one case comes to with one filter, over several random scenes; in fp64, and the
/// weights of the same maps in fp32.
struct StabilityRow : WeightErrors {
    std::string case_name, filter;
    double condition = 0.0;
    std::size_t scenes = 0, weights = 0;
    WeightErrors fp32;
    std::uint64_t exact_depths = 0;  ///< depth comparisons that the filter left to exact arithmetic
    std::uint64_t fine_orders = 0;   ///< orders of two lines that doubles left to their canonical points
    std::uint64_t closings = 0;      ///< pieces that close what rounded planes left open
    double oracle_error = 0.0;       ///< the oracle's own estimate
    std::optional<MapReport> map;    ///< of the support's square, face by face: all scenes compared together
    std::string map_left_out;        ///< why not all maps were compared; empty where they were
    std::optional<ProjectionErrors> projection;  ///< of cases that a camera sees: all scenes together
};

/// Maps of more triangles are not compared: every point asked is looked for in each triangle, exactly.
inline constexpr std::size_t kMostTrianglesCompared = 300;

/// Adds what compareMaps() says to the row, or why it was not asked.
void judgeMap(const ScreenScene& scene, const std::vector<exact::Face>& faces, const VisibleMap& map,
              const exact::Region& box, StabilityRow& row);

/// No error beyond its bound, and no owner or label wrong.
bool keepsPromises(const StabilityRow& row);

/// A weight that n terms make errs by at most n (10 u + 2^-61) + 2^-61, u = 2^-53: ten roundings of a term
/// that is below 1, and the fixed point's. In fp32 by at most 64 * 2^-24.
double promisedBound(std::uint64_t terms, Precision precision = Precision::kFp64);

struct StabilityOptions {
    std::vector<Prefilter> filters;
    int scenes = 4;                  ///< a difficulty
    int every = 1;                   ///< of a case's difficulties only each so-manieth is run
    std::vector<std::string> cases;  ///< names; empty: all
};

/// Throws InputError for an unknown case.
void checkCases(const StabilityOptions& options);

/// Rows by case, filter, difficulty. Throws InputError for an unknown case, Interrupted when cancelled.
std::vector<StabilityRow> runStability(const StabilityOptions& options, Progress& progress);

}  // namespace edgewise::judge
