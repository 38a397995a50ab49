// What the sphere-tracing page measures: Keinert et al. 2014 beside what came after, on scenes of our own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/picture_row.h"
#include "pipeline/field_tracer.h"

namespace edgewise::figures {

/// What a pixel is whose ray ends elsewhere than classic tracing's.
enum class HitChange : unsigned char {
    kSilhouette,  ///< one of the eight pixels around it shows the other surface: an outline runs through it
    kGrazing,     ///< none does, but the other depth lies between theirs: depth changes so fast from pixel to
                  ///< pixel
    kNarrow,  ///< nor that, but none shows the classic surface either: a gap or a thing narrower than a pixel
    kAlone    ///< none of these
};
const char* nameOf(HitChange kind);

struct ChangedHit {
    int x = 0, y = 0;
    double classic_depth = 0.0, depth = 0.0;  ///< along the ray; infinite: nothing
    HitChange kind = HitChange::kAlone;
};

/// Rays of one picture under one setting. Times are of tracing, medians over the runs.
struct TraceRun {
    std::string setting;
    bool parameter_free = false;
    double seconds = 0.0;
    std::uint64_t evaluations = 0, iterations = 0;
    std::uint64_t changed = 0;  ///< pixels that hit something else than classic tracing hits
};

struct TracedScene {
    std::string name;
    int width = 0, height = 0;
    std::uint64_t rays = 0;
    std::vector<TraceRun> runs;       ///< the first is classic
    std::vector<ChangedHit> changed;  ///< of the last setting against classic
    std::optional<double> published;  ///< Keinert's ratio of times, on a scene of his own of that kind
    std::string remark;
    double ratioOf(const TraceRun& run) const {
        return double(runs[0].evaluations) / double(run.evaluations);
    }
};

/// Section 3.2: pixels at `steps` steps that do not show what rays show that may take all they need.
struct CandidateKind {
    std::uint64_t wrong = 0;  ///< a surface that is not there: its normal is another's
    std::uint64_t holes = 0;  ///< the background
};
struct CandidateCount {
    std::string scene;
    int steps = 0;
    std::uint64_t pixels = 0;
    CandidateKind last = {}, screen = {};
};

/// Section 3.4: jumps of f(p) from pixel to pixel of one surface, where slope times cosine is at least 0.6.
struct JumpCount {
    std::string scene;
    std::uint64_t pairs = 0;
    double median_before = 0.0, median_after = 0.0;  ///< world units, with 0 and 3 steps
};

struct PruningCount {
    std::string scene;
    int width = 0, height = 0;
    double seconds_whole = 0.0, seconds_pruned = 0.0, build_seconds = 0.0;
    double instructions_whole = 0.0, instructions_pruned = 0.0;  ///< an evaluation
    std::uint64_t differing = 0;                                 ///< pixels whose depth differs in any bit
};

struct SphereTracing {
    bool quick = false;
    int runs = 1;
    double seconds = 0.0;  ///< that all of it took
    std::vector<TracedScene> scenes;
    std::vector<TracedScene> convex;  ///< with the shortcut and without
    std::vector<CandidateCount> candidates;
    std::vector<JumpCount> jumps;
    std::vector<PruningCount> pruning;
    std::vector<PictureRow> pictures;
    std::vector<std::string> notes;
};

/// Of a setting over all scenes that have it.
double geometricMeanRatio(const SphereTracing& found, const std::string& setting);

std::string sphereTracingHtml(const SphereTracing& found);
std::string sphereTracingJson(const SphereTracing& found);

}  // namespace edgewise::figures
