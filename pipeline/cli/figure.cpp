#include "paper_figures/figure.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "paper_figures/index_page.h"
#include "pipeline/atomic_file.h"
#include "pipeline/cli/command.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/report.h"
#include "pipeline/cli/result_folder.h"
#include "pipeline/error.h"
#include "pipeline/progress_bar.h"

namespace edgewise::cli {
namespace {

using figures::Figure;
using figures::MadeFigure;

struct FigureArguments {
    std::vector<std::string> names;
    std::string folder;
    bool quick = false, quiet = false;
};

/// Each once, in the registry's order.
std::vector<const Figure*> chosenFigures(const std::vector<std::string>& names) {
    const auto& all = figures::figureRegistry();
    for (const std::string& name : names)
        if (name != "all" && std::ranges::find(all, name, &Figure::name) == all.end())
            throw InputError("'" + name + "'", "is no figure; `edgewise figures` lists them");
    std::vector<const Figure*> chosen;
    for (const Figure& figure : all)
        for (const std::string& name : names)
            if (name == "all" || name == figure.name) {
                chosen.push_back(&figure);
                break;
            }
    return chosen;
}

/// DIR/NAME with the figure's files. What it could not make is said, and the others go on.
MadeFigure makeFigure(const Figure& figure, const FigureArguments& arguments, const ResultFolder& folder,
                      Progress& progress) {
    try {
        const auto files = figure.make({arguments.quick, progress});
        throwIfInterrupted();
        const ResultFolder own((folder / figure.name).string());
        for (const figures::FigureFile& file : files) writeAtomically(own / file.name, file.bytes);
        return {&figure, figure.name + "/" + files.front().name, ""};
    } catch (const FailureError& error) {
        return {&figure, "", error.what()};
    }
}

void makeFigures(const FigureArguments& arguments) {
    const auto chosen = chosenFigures(arguments.names);
    const ResultFolder folder(arguments.folder);
    std::vector<MadeFigure> made;
    {
        ProgressBar progress(!arguments.quiet && isatty(STDERR_FILENO), interruptFlag());
        for (const Figure* figure : chosen) made.push_back(makeFigure(*figure, arguments, folder, progress));
    }
    writeAtomically(folder / "index.html", figures::indexHtml(made, arguments.quick));
    const auto failed = std::ranges::find_if(made, [](const MadeFigure& one) { return one.page.empty(); });
    for (const MadeFigure& one : made)
        if (one.page.empty() && &one != &*failed) printError(one.figure->name + ": " + one.why);
    if (failed != made.end()) throw FailureError(failed->figure->name, failed->why);
    if (!arguments.quiet) fmt::print("{}\n", (folder / "index.html").string());
}

}  // namespace

void addFigure(CLI::App& program) {
    CLI::App* command = program.add_subcommand("figure", "the papers' figures and tables");
    auto arguments = std::make_shared<FigureArguments>();
    command->add_option("NAME", arguments->names, "`edgewise figures` lists them; all: every one")
        ->required();
    command
        ->add_option("-o,--output", arguments->folder,
                     "index.html, and a folder with the files of each figure")
        ->type_name("DIR")
        ->required();
    command->add_flag("--quick", arguments->quick, "a small version of everything");
    command->add_flag("--quiet", arguments->quiet, "no progress bar, no chatter");
    command->callback([arguments] { makeFigures(*arguments); });
}

}  // namespace edgewise::cli
