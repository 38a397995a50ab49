// Four scenes as fields and as meshes of them: what each family's antialiasing costs on one geometry.
#include "paper_figures/shared_geometry.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "paper_figures/compared_scene.h"
#include "pipeline/atomic_file.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/read_file.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/scoped_path.h"

namespace edgewise::figures {
namespace {

using Json = nlohmann::ordered_json;

struct Effort {
    int side, runs;
    std::size_t most_meshes;
    std::vector<std::string> scenes, methods;
};

const std::vector<std::string> kMethods{"nsaa",   "ssaa:2", "ssaa:4", "ssaa:8",      "ctss",
                                        "ctss-r", "ctss-x", "lottes", "mesh+ssaa:4", "mesh+ssaa:8",
                                        "rt:4",   "rt:16",  "rt:64",  "none",        "mesh+none"};

Effort effortOf(bool quick) {
    if (quick)
        return {64,
                1,
                2,
                {"sphere-minus-box"},
                {"nsaa", "ssaa:2", "ssaa:4", "ctss", "ctss-x", "lottes", "rt:16", "none"}};
    return {128, 3, 3, {"sphere-minus-box", "gyroid", "spheres-50", "menger-3"}, kMethods};
}

void measureScene(const std::string& name, const Effort& effort, const std::filesystem::path& folder,
                  SharedGeometry& found, Progress& progress) try {
    const std::filesystem::path file = folder / (name + ".sdf.json");
    writeAtomically(file, bareScene(readText(findScene(name)), name));
    Labelled labelled(progress, name);
    const compare::ScheduleOptions schedule{effort.runs, HUGE_VAL, folder, true};
    compare::Comparison scene =
        compareOn({file, effort.side, effort.side, "box", 0.5, "cpu", effort.most_meshes}, found.reference,
                  knownOf(effort.methods, found.notes), schedule, labelled);
    scene.scene = name;
    for (const compare::Row& row : scene.rows)
        if (!row.why.empty()) found.notes.push_back(name + ", " + row.method + ": " + row.why);
    found.scenes.push_back(std::move(scene));
} catch (const compare::WorkerFailure& failure) {
    found.notes.push_back(name + ": " + failure.what());
}

SharedGeometry measure(bool quick, Progress& progress) {
    const Effort effort = effortOf(quick);
    const ScopedPath folder = temporaryFolder();
    Stopwatch watch;
    SharedGeometry found;
    found.quick = quick, found.runs = effort.runs, found.reference = "nsaa";
    for (const std::string& name : effort.scenes) {
        measureScene(name, effort, folder.path(), found, progress);
        if (progress.cancelled()) throw Interrupted();
    }
    found.seconds = watch.lap();
    return found;
}

}  // namespace

std::string bareScene(const std::string& text, const std::string& source) try {
    Json scene = Json::parse(text);
    for (Json& light : scene["lights"]) light["shadows"] = false;
    Json& tree = scene.at("tree");
    if (tree.at("type") == "union") {
        Json kept = Json::array();
        for (Json& child : tree.at("children")) {
            if (child.at("type") == "menger") child.erase("rotate");
            if (child.at("type") != "plane") kept.push_back(child);
        }
        tree["children"] = kept;
    }
    return scene.dump(1) + "\n";
} catch (const Json::exception& error) {
    throw InputError(source, error.what());
}

std::optional<double> samplesFor(double rmse, const std::vector<compare::Row>& rows) {
    std::vector<std::pair<double, double>> known;  // log samples, log error
    for (const compare::Row& row : rows) {
        if (!row.error || !(row.error->rmse > 0.0)) continue;
        const MethodSpec spec = parseMethod(row.method);
        if (spec.mesh || !(spec.name == "none" || spec.name == "ssaa")) continue;
        known.emplace_back(2.0 * std::log(spec.number.value_or(1)), std::log(row.error->rmse));
    }
    std::ranges::sort(known);
    const double wanted = std::log(rmse);
    for (std::size_t i = 1; i < known.size(); ++i) {
        const auto& [n, high] = known[i - 1];
        const auto& [m, low] = known[i];
        if (wanted > high || wanted < low || low == high) continue;
        return std::exp(n + (m - n) * (high - wanted) / (high - low));
    }
    return std::nullopt;
}

std::vector<FigureFile> makeSharedGeometry(const FigureInput& input) {
    const SharedGeometry found = measure(input.quick, input.progress);
    addSharedClaims(found, input.claims);
    const auto plots = sharedGeometryPlots(found);
    std::vector<FigureFile> files{{"report.html", sharedGeometryHtml(found, plots)},
                                  {"results.csv", sharedGeometryCsv(found)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
