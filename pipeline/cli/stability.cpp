#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/atomic_file.h"
#include "pipeline/cli/command.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/parse_values.h"
#include "pipeline/cli/result_folder.h"
#include "pipeline/error.h"
#include "pipeline/judge/stability_cases.h"
#include "pipeline/judge/stability_report.h"
#include "pipeline/progress_bar.h"

namespace edgewise::cli {
namespace {

constexpr int kMostScenes = 10000;

struct StabilityArguments {
    std::string folder, command_line;
    std::vector<std::string> filters, cases;
    std::string scenes = "4";
    bool quiet = false;
};

judge::StabilityOptions readOptions(const StabilityArguments& arguments) {
    judge::StabilityOptions options;
    const std::vector<std::string> usual{"box", "cone", "gaussian", "mitchell"};
    for (const std::string& name : arguments.filters.empty() ? usual : arguments.filters) {
        try {
            options.filters.push_back(makePrefilter(name, {}, {}));
        } catch (const std::invalid_argument& error) {
            throw InputError("--filter " + name, error.what());
        }
    }
    options.cases = arguments.cases;
    options.scenes = static_cast<int>(parseInteger("--scenes", arguments.scenes, 1, kMostScenes));
    return options;
}

std::string caseNames() {
    std::string out;
    for (const judge::StabilityCase& one : judge::stabilityCases())
        out += (out.empty() ? "" : ", ") + one.name;
    return out;
}

void stability(const StabilityArguments& arguments) {
    const judge::StabilityOptions options = readOptions(arguments);
    judge::checkCases(options);
    const ResultFolder folder(arguments.folder);
    ProgressBar progress(!arguments.quiet && isatty(STDERR_FILENO), interruptFlag());
    const auto rows = judge::runStability(options, progress);
    writeAtomically(folder / "results.json", judge::stabilityJson(rows, arguments.command_line));
    writeAtomically(folder / "results.csv", judge::stabilityCsv(rows));
    writeAtomically(folder / "table.tex", judge::stabilityLatex(rows));
    writeAtomically(folder / "stability.html", judge::stabilityHtml(rows, arguments.command_line));
}

}  // namespace

void addStability(CLI::App& program, const std::string& command_line) {
    CLI::App* command = program.add_subcommand(
        "stability", "stiff and extreme cases: error against condition, tables and plots");
    auto arguments = std::make_shared<StabilityArguments>();
    arguments->command_line = command_line;
    command
        ->add_option("-o,--output", arguments->folder, "results.json, results.csv, table.tex, stability.html")
        ->type_name("DIR")
        ->required();
    command->add_option("--filter", arguments->filters, "repeated [box, cone, gaussian, mitchell]")
        ->type_name("F")
        ->allow_extra_args(false);
    command->add_option("--case", arguments->cases, "repeated [all]: " + caseNames())
        ->type_name("NAME")
        ->allow_extra_args(false);
    command->add_option("--scenes", arguments->scenes, "random scenes a difficulty")
        ->type_name("N")
        ->capture_default_str();
    command->add_flag("--quiet", arguments->quiet, "no progress bar");
    command->callback([arguments] { stability(*arguments); });
}

}  // namespace edgewise::cli
