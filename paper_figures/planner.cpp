// The plan's savings one by one: each is forced off in turn, in worker processes as compare has them.
#include "paper_figures/planner.h"

#include <fmt/format.h>

#include <algorithm>

#include "paper_figures/compared_scene.h"
#include "pipeline/compare/worker_process.h"
#include "pipeline/error.h"
#include "pipeline/plan.h"
#include "pipeline/scene_catalog.h"
#include "pipeline/scoped_path.h"

namespace edgewise::figures {
namespace {

/// Switches of `sphere`, whose names are the plan's.
const std::vector<std::string> kFieldSavings{"prepass", "prune", "convex"};

struct Effort {
    int runs = 3;
    double budget_seconds = 15.0;
    std::vector<std::string> scenes;
    ComparedPicture triangles{"", 512, 512, "gaussian", 2.0}, field{"", 480, 270, "box", 0.5};
};

Effort effortFor(bool quick) {
    Effort effort;
    for (const SceneInfo& scene : sceneNames()) effort.scenes.push_back(scene.name);
    if (!quick) return effort;
    effort.runs = 1;
    effort.scenes = {"random-2k", "primitives"};
    effort.triangles.width = effort.triangles.height = 96;
    effort.field.width = 96, effort.field.height = 54;
    return effort;
}

struct Variant {
    std::string name;  ///< empty: as planned
    compare::Contender contender;
};

std::vector<Variant> variantsOf(const ComparedPicture& picture, bool field) {
    const std::string method = field ? "sphere" : "nsaa";
    std::vector<Variant> variants{{"", {method, workerArguments(picture, method)}}};
    if (field) {
        for (const std::string& name : kFieldSavings) {
            const std::string off = fmt::format("sphere:{}=off", name);
            variants.push_back({name, {off, workerArguments(picture, off)}});
        }
        return variants;
    }
    std::vector<std::string> names = skippableStages();
    names.push_back("all");
    for (const std::string& name : names) {
        std::vector<std::string> arguments = workerArguments(picture, method);
        arguments.push_back("--no-skip=" + name);
        variants.push_back({name, {method, std::move(arguments)}});
    }
    return variants;
}

PlannerScene measureScene(const std::string& name, const Effort& effort, const std::filesystem::path& scratch,
                          Progress& progress) {
    const bool field = findScene(name).string().ends_with(".json");
    ComparedPicture picture = field ? effort.field : effort.triangles;
    picture.scene = name;
    const std::vector<Variant> variants = variantsOf(picture, field);
    std::vector<compare::Contender> contenders;
    std::vector<compare::Row> rows;
    for (const Variant& variant : variants) {
        contenders.push_back(variant.contender);
        rows.push_back(compare::rowOf(parseMethod(variant.contender.method),
                                      makePrefilter(picture.filter, picture.radius, {})));
    }
    Labelled labelled(progress, name);
    compare::runByTurns(
        contenders, {effort.runs, effort.budget_seconds, scratch, false}, rows,
        [](std::size_t, const ImageBuffer&) {}, [](std::size_t) {}, labelled);
    PlannerScene scene{name, field, std::move(rows[0]), {}};
    for (std::size_t i = 1; i < rows.size(); ++i)
        scene.forced.push_back({variants[i].name, std::move(rows[i])});
    return scene;
}

Planner measure(const Effort& effort, Progress& progress) {
    const ScopedPath scratch = temporaryFolder();
    Planner found;
    found.runs = effort.runs, found.budget_seconds = effort.budget_seconds;
    for (const std::string& name : effort.scenes) {
        try {
            found.scenes.push_back(measureScene(name, effort, scratch.path(), progress));
        } catch (const compare::WorkerFailure& failure) {
            found.notes.push_back(name + ": " + failure.what());
        } catch (const InputError& error) {
            found.notes.push_back(name + ": " + error.what());
        }
        if (progress.cancelled()) throw Interrupted();
    }
    return found;
}

double medianOf(const compare::Row& row, const std::string& stage) {
    const auto found = row.stages.find(stage);
    return found == row.stages.end() ? 0.0 : compare::spreadOf(found->second).median;
}

void findStage(const compare::Row& without, const compare::Row& planned, Saving& saving) {
    for (const auto& [stage, seconds] : without.stages) {
        const double a = medianOf(without, stage), b = medianOf(planned, stage);
        if (saving.stage.empty() || a - b > saving.stage_without - saving.stage_planned)
            saving.stage = stage, saving.stage_without = a, saving.stage_planned = b;
    }
}

Saving savingOf(const PlannerScene& scene, const PlannerScene::Forced& forced, double budget_seconds) {
    Saving saving;
    saving.scene = scene.name, saving.name = forced.name, saving.field = scene.field;
    for (const PlanEntry& entry : scene.planned.plan)
        // a stage that does not run is the saving; of tracing the savings are what runs
        if (entry.stage == forced.name) saving.used = entry.runs == scene.field, saving.why = entry.why;
    if (scene.planned.seconds.empty()) return saving;
    const double planned = compare::spreadOf(scene.planned.seconds).median;
    if (forced.row.status == compare::RowStatus::kTimeout && forced.row.seconds.empty())
        saving.ratio = budget_seconds / planned, saving.at_least = true;
    else if (!forced.row.seconds.empty()) {
        saving.ratio = compare::spreadOf(forced.row.seconds).median / planned;
        findStage(forced.row, scene.planned, saving);
    }
    return saving;
}

}  // namespace

std::vector<Saving> savingsOf(const Planner& found) {
    std::vector<Saving> savings;
    for (const PlannerScene& scene : found.scenes)
        for (const PlannerScene::Forced& forced : scene.forced)
            savings.push_back(savingOf(scene, forced, found.budget_seconds));
    return savings;
}

std::vector<FigureFile> makePlanner(const FigureInput& input) {
    Planner found = measure(effortFor(input.quick), input.progress);
    found.quick = input.quick;
    const auto plots = plannerPlots(found);
    std::vector<FigureFile> files{{"report.html", plannerHtml(found, plots)},
                                  {"results.csv", plannerCsv(found)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
