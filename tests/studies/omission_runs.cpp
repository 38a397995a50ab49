#include "tests/studies/omission_runs.h"

#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "pipeline/error.h"
#include "pipeline/load_gltf.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "tests/studies/peak_memory.h"

namespace edgewise::study {
namespace {

struct TimedResult {
    MethodResult result;
    double seconds = 0.0;
};

/// Stops what takes too long.
struct Deadline : Progress {
    explicit Deadline(double limit_seconds) : limit(limit_seconds) {}
    bool cancelled() override { return std::chrono::steady_clock::now() - start > limit; }
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    const std::chrono::duration<double> limit;  ///< may be infinite
};

/// One scene, ready to be rendered again and again.
class Subject {
  public:
    Subject(const std::string& name, const StudyOptions& options)
        : options_(options), scene_(loadGltf(findScene(name))) {
        CameraOptions camera;
        camera.size = glm::ivec2(options.width, options.height);
        camera_ = resolveCamera(scene_, camera, film_);
    }

    /// Throws Interrupted past the limit.
    TimedResult render(const std::string& forced) const {
        RenderOptions options;
        options.threads = options_.threads;
        options.memory_mib = 1 << 16;  // one band: the study is about omissions
        if (!forced.empty()) options.no_skip.insert(forced);
        Deadline progress(forced.empty() ? HUGE_VAL : options_.limit_seconds);
        TimedResult timed;
        const auto start = std::chrono::steady_clock::now();
        timed.result =
            runMethod(parseMethod("nsaa"), {scene_, camera_, film_, options_.filter, options, progress});
        timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return timed;
    }

  private:
    const StudyOptions& options_;
    Scene scene_;
    ResolvedCamera camera_;
    Film film_;
};

double largestDifference(const ImageBuffer& a, const ImageBuffer& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        for (glm::length_t k = 0; k < 4; ++k)
            largest = std::max(largest, std::abs(a.rgba[i][k] - b.rgba[i][k]));
    return largest;
}

bool leavesOut(const MethodResult& result, const std::string& omission) {
    return omission == "all" ||
           std::any_of(result.plan.begin(), result.plan.end(),
                       [&](const PlanEntry& entry) { return entry.stage == omission && !entry.runs; });
}

OmissionCost warmUp(const Subject& subject, const MethodResult& by_default, const std::string& omission) {
    OmissionCost cost;
    cost.name = omission;
    cost.fires = leavesOut(by_default, omission);
    try {
        cost.difference = largestDifference(by_default.image, subject.render(omission).result.image);
    } catch (const Interrupted&) {
        cost.over_limit = true;
    }
    return cost;
}

/// Stage times of many runs, kept in the order in which the stages first came.
class StageSamples {
  public:
    void add(const std::vector<StageTime>& stages) {
        for (const StageTime& stage : stages) {
            if (!seconds_.contains(stage.name)) order_.push_back(stage.name);
            seconds_[stage.name].push_back(stage.seconds);
        }
    }
    std::vector<std::pair<std::string, double>> medians() const {
        std::vector<std::pair<std::string, double>> all;
        for (const std::string& name : order_) all.emplace_back(name, Seconds(seconds_.at(name)).median());
        return all;
    }

  private:
    std::vector<std::string> order_;
    std::map<std::string, std::vector<double>> seconds_;
};

}  // namespace

Seconds::Seconds(std::vector<double> values) : sorted(std::move(values)) {
    std::sort(sorted.begin(), sorted.end());
}

double Seconds::median() const {
    const std::size_t n = sorted.size();
    return 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

double Seconds::interquartile() const {
    const std::size_t n = sorted.size();
    return sorted[n - 1 - n / 4] - sorted[n / 4];
}

double SceneCosts::stageSeconds(const std::string& name) const {
    for (const auto& [stage, seconds] : stages)
        if (stage == name) return seconds;
    return 0.0;
}

double SceneCosts::nanosecondsPerTerm() const {
    const auto terms = static_cast<double>(counts.at("terms"));
    return stageSeconds("weights") * 1e9 * threads / terms;
}

SceneCosts measureScene(const std::string& name, const StudyOptions& options) {
    SceneCosts costs;
    costs.scene = name;
    costs.threads = options.threads > 0 ? options.threads : oneapi::tbb::info::default_concurrency();
    const Subject subject(name, options);
    resetPeakMemory();
    const MethodResult by_default = subject.render("").result;
    costs.peak_mib = peakMemoryMib();
    costs.counts = by_default.counts;

    StageSamples stages;
    std::vector<double> totals;
    for (const std::string& omission : options.omissions) {
        OmissionCost cost = warmUp(subject, by_default, omission);
        std::vector<double> with, without;
        for (int run = 0; run < options.runs; ++run) {
            const TimedResult plain = subject.render("");
            with.push_back(plain.seconds);
            stages.add(plain.result.stages);
            if (!cost.over_limit) without.push_back(subject.render(omission).seconds);
        }
        totals.insert(totals.end(), with.begin(), with.end());
        cost.with = Seconds(with), cost.without = Seconds(without);
        costs.omissions.push_back(std::move(cost));
    }
    costs.total = Seconds(totals);
    costs.stages = stages.medians();
    return costs;
}

}  // namespace edgewise::study
