// Runs a scene with and without each of the planner's omissions, in turns, so that a busy machine slows both
// alike.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analytic/prefilter.h"
#include "pipeline/methods/method.h"

namespace edgewise::study {

struct StudyOptions {
    std::vector<std::string> scenes;  ///< names or files
    std::vector<std::string> omissions;
    int width = 1024, height = 1024;
    int runs = 5;                 ///< of either kind, after one warm-up of each
    int threads = 0;              ///< 0: all
    double limit_seconds = 60.0;  ///< of a run without an omission: then it is stopped, and not run again
    Prefilter filter;
};

/// Seconds of every run, sorted.
struct Seconds {
    std::vector<double> sorted;

    explicit Seconds(std::vector<double> values = {});
    double median() const;
    /// Half of the runs lie within this, around the median.
    double interquartile() const;
};

struct OmissionCost {
    std::string name;
    bool fires = false;     ///< the plan leaves it out on this scene
    Seconds with, without;  ///< without: empty where the limit was met
    bool over_limit = false;
    double difference = 0.0;  ///< largest, of any channel of any pixel

    double savedPercent() const { return 100.0 * (1.0 - with.median() / without.median()); }
};

struct SceneCosts {
    std::string scene;
    std::vector<OmissionCost> omissions;
    Seconds total;                                       ///< of the default runs, like what follows
    std::vector<std::pair<std::string, double>> stages;  ///< median seconds, in the pipeline's order
    std::map<std::string, std::uint64_t> counts;
    double peak_mib = 0.0;
    int threads = 0;

    double stageSeconds(const std::string& name) const;
    /// Nanoseconds of one thread a (segment, sample) term.
    double nanosecondsPerTerm() const;
};

/// Throws what loading and rendering throw.
SceneCosts measureScene(const std::string& scene, const StudyOptions& options);

}  // namespace edgewise::study
