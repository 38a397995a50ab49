// Every method on every scene, by turns: what an error costs.
#include "paper_figures/error_time.h"

#include <algorithm>
#include <cmath>

#include "paper_figures/compared_scene.h"
#include "pipeline/compare/error_slope.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/scoped_path.h"

namespace edgewise::figures {
namespace {

struct KindEffort {
    int width, height;
    std::string reference;
    std::vector<std::string> methods;
};

struct Effort {
    int runs;
    double budget_seconds;
    std::vector<std::string> scenes;
    KindEffort triangles, field;
};

Effort fullEffort() {
    Effort effort{3, 5.0, {}, {}, {}};
    for (const SceneInfo& scene : sceneNames()) effort.scenes.push_back(scene.name);
    effort.triangles = {512,
                        512,
                        "nsaa,device=cpu",
                        {"none",
                         "nsaa",
                         "ssaa:2",
                         "ssaa:4",
                         "ssaa:8",
                         "rt:1",
                         "rt:4",
                         "rt:16",
                         "rt:64",
                         "msaa:2",
                         "msaa:4",
                         "msaa:8",
                         "msaa:16",
                         "csaa:32",
                         "smaa",
                         "fxaa",
                         "none,device=vulkan",
                         "nsaa,device=vulkan",
                         "ssaa:4,device=vulkan",
                         "msaa:4,device=vulkan"}};
    effort.field = {240,
                    135,
                    "ssaa:16,device=cpu",
                    {"none", "ssaa:2", "ssaa:3", "ssaa:4", "ssaa:8", "smaa", "fxaa", "sphere", "ctss",
                     "ctss-r", "ctss-x", "ctss+ssaa:2", "lottes", "path:4"}};
    return effort;
}

Effort quickEffort() {
    Effort effort = fullEffort();
    effort.runs = 1;
    effort.scenes = {"random-2k", "primitives"};
    effort.triangles.width = effort.triangles.height = 96;
    effort.triangles.methods = {"none", "nsaa", "ssaa:2", "ssaa:4", "rt:4", "msaa:4", "smaa"};
    effort.field.width = 64, effort.field.height = 36, effort.field.reference = "ssaa:8,device=cpu";
    effort.field.methods = {"none", "ssaa:2", "smaa", "ctss", "ctss-x"};
    return effort;
}

SceneKind kindOf(const std::string& scene) {
    return findScene(scene).string().ends_with(".json") ? SceneKind::kField : SceneKind::kTriangles;
}

void measureScene(const std::string& name, const Effort& effort, const std::filesystem::path& scratch,
                  ErrorTime& found, Progress& progress) try {
    const SceneKind kind = kindOf(name);
    const KindEffort& own = kind == SceneKind::kField ? effort.field : effort.triangles;
    Labelled labelled(progress, name);
    const ComparedPicture picture{name, own.width, own.height};
    ErrorTimeScene scene{kind, compareOn(picture, own.reference, knownOf(own.methods, found.notes),
                                         {effort.runs, effort.budget_seconds, scratch, true}, labelled)};
    for (const compare::Row& row : scene.comparison.rows)
        if (!row.why.empty()) found.notes.push_back(name + ", " + row.method + ": " + row.why);
    found.scenes.push_back(std::move(scene));
} catch (const compare::WorkerFailure& failure) {
    found.notes.push_back(name + ": " + failure.what());
} catch (const InputError& error) {
    found.notes.push_back(name + ": " + error.what());
}

ErrorTime measure(const Effort& effort, Progress& progress) {
    const ScopedPath scratch = temporaryFolder();
    Stopwatch watch;
    ErrorTime found;
    found.runs = effort.runs, found.budget_seconds = effort.budget_seconds;
    for (const std::string& name : effort.scenes) {
        measureScene(name, effort, scratch.path(), found, progress);
        if (progress.cancelled()) throw Interrupted();
    }
    found.seconds = watch.lap();
    return found;
}

bool isKnown(const compare::Row& row) {
    return row.error && !row.seconds.empty();
}
double timeOf(const compare::Row& row) {
    return compare::spreadOf(row.seconds).median;
}

/// Sums of logarithms.
struct MeanOfRatios {
    double sum = 0.0;
    std::size_t count = 0;
    void add(double ratio) { sum += std::log(ratio), ++count; }
    double value() const { return std::exp(sum / static_cast<double>(count)); }
};

struct MethodSums {
    MethodMean mean;
    MeanOfRatios time, error;
};

void addScene(const compare::Comparison& comparison, std::vector<MethodSums>& sums) {
    const auto& rows = comparison.rows;
    const auto none = std::ranges::find(rows, "none", &compare::Row::method);
    if (none == rows.end() || !isKnown(*none)) return;
    const std::vector<bool> front = onFront(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!isKnown(rows[i])) continue;
        auto own = std::ranges::find(sums, rows[i].method, [](const MethodSums& s) { return s.mean.method; });
        if (own == sums.end()) {
            own = sums.insert(sums.end(), MethodSums());
            own->mean.method = rows[i].method, own->mean.family = compare::familyOf(rows[i]);
        }
        ++own->mean.scenes, own->mean.fronts += front[i];
        own->time.add(timeOf(rows[i]) / timeOf(*none));
        const double error = rows[i].error->rmse, of = none->error->rmse;
        if (error > 0.0 && of > 0.0) own->error.add(error / of);
    }
}

}  // namespace

std::vector<bool> onFront(const std::vector<compare::Row>& rows) {
    std::vector<bool> front;
    for (const compare::Row& row : rows)
        front.push_back(isKnown(row) && std::ranges::none_of(rows, [&](const compare::Row& other) {
                            return isKnown(other) && other.error->rmse < row.error->rmse &&
                                   timeOf(other) < timeOf(row);
                        }));
    return front;
}

std::vector<MethodMean> methodMeans(const ErrorTime& found, SceneKind kind) {
    std::vector<MethodSums> sums;
    for (const ErrorTimeScene& scene : found.scenes)
        if (scene.kind == kind) addScene(scene.comparison, sums);
    std::vector<MethodMean> means;
    for (MethodSums& one : sums) {
        one.mean.time_ratio = one.time.value();
        if (one.error.count > 0) one.mean.error_ratio = one.error.value();
        means.push_back(std::move(one.mean));
    }
    return means;
}

std::vector<FigureFile> makeErrorTime(const FigureInput& input) {
    ErrorTime found = measure(input.quick ? quickEffort() : fullEffort(), input.progress);
    found.quick = input.quick;
    const auto plots = errorTimePlots(found);
    std::vector<FigureFile> files{{"report.html", errorTimeHtml(found, plots)},
                                  {"results.csv", errorTimeCsv(found)},
                                  {"means.csv", meansCsv(found)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
