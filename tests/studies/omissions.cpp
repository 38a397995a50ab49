// What does each of the planner's omissions save, on every scene? Prints two Markdown tables.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <functional>

#include "pipeline/atomic_file.h"
#include "pipeline/plan.h"
#include "pipeline/scene_catalog.h"
#include "tests/studies/omission_tables.h"

namespace edgewise::study {
namespace {

struct Arguments {
    std::vector<std::string> scenes, omissions, filters{"box", "gaussian"};
    std::string size = "1024x1024", output;
    int runs = 5, threads = 0;
    double limit = 60.0;
};

std::vector<std::string> everyScene() {
    std::vector<std::string> names;
    for (const SceneInfo& scene : sceneNames()) names.push_back(scene.name);
    return names;
}

std::vector<std::string> everyOmission() {
    std::vector<std::string> names = skippableStages();
    names.push_back("all");
    return names;
}

void addOptions(CLI::App& program, Arguments& arguments) {
    program.add_option("--scenes", arguments.scenes, "names or files [every name]")->delimiter(',');
    program.add_option("--omissions", arguments.omissions, "names that --no-skip takes [every one]")
        ->delimiter(',');
    program.add_option("--runs", arguments.runs, "of either kind, after a warm-up")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    program.add_option("--size", arguments.size, "WxH px")->capture_default_str();
    program.add_option("--filter", arguments.filters, "with its default radius; repeatable")
        ->capture_default_str();
    program.add_option("--threads", arguments.threads, "0: all")
        ->check(CLI::Range(0, 4096))
        ->capture_default_str();
    program
        .add_option("--limit", arguments.limit,
                    "seconds of a run without an omission, which is then given up")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    program.add_option("-o,--output", arguments.output, "a file for the tables beside standard output");
}

StudyOptions readOptions(const Arguments& arguments, const std::string& filter) {
    StudyOptions options;
    options.scenes = arguments.scenes.empty() ? everyScene() : arguments.scenes;
    options.omissions = arguments.omissions.empty() ? everyOmission() : arguments.omissions;
    options.runs = arguments.runs;
    options.threads = arguments.threads;
    options.limit_seconds = arguments.limit;
    options.filter = makePrefilter(filter, {}, {});
    int used = 0;
    if (std::sscanf(arguments.size.c_str(), "%dx%d%n", &options.width, &options.height, &used) != 2 ||
        arguments.size.size() != static_cast<std::size_t>(used))
        throw std::invalid_argument("--size: '" + arguments.size + "' is not WxH");
    return options;
}

/// The tables of one filter. `keep` gets them after every scene, so that an interrupted study leaves what it
/// has. A scene that cannot be made here is named, and the others go on.
std::string study(const StudyOptions& options, const std::function<void(const std::string&)>& keep) {
    std::vector<SceneCosts> costs;
    std::string failures, text;
    for (const std::string& scene : options.scenes) {
        fmt::print(stderr, "{} {}\n", options.filter.name, scene);
        try {
            costs.push_back(measureScene(scene, options));
        } catch (const std::runtime_error& error) {
            failures += fmt::format("{}: {}\n\n", scene, error.what());
        }
        text = "## " + describeStudy(options) + omissionTable(costs, options) + stageTable(costs) + failures;
        keep(text);
    }
    return text;
}

int run(int count, char** words) {
    CLI::App program("What each of the planner's omissions saves.");
    Arguments arguments;
    addOptions(program, arguments);
    CLI11_PARSE(program, count, words);
    std::string text;
    const auto keep = [&](const std::string& part) {
        if (!arguments.output.empty()) writeAtomically(arguments.output, text + part);
    };
    for (const std::string& filter : arguments.filters) text += study(readOptions(arguments, filter), keep);
    fmt::print("{}", text);
    return 0;
}

}  // namespace
}  // namespace edgewise::study

int main(int count, char** words) {
    try {
        return edgewise::study::run(count, words);
    } catch (const std::exception& error) {
        fmt::print(stderr, "omissions: error: {}\n", error.what());
        return 2;
    }
}
