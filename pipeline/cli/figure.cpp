#include "paper_figures/figure.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "paper_figures/figure_stamp.h"
#include "paper_figures/index_page.h"
#include "paper_figures/make_figure.h"
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

/// Of one figure among those that are made: stages are named after it.
class FigureProgress : public Progress {
  public:
    FigureProgress(Progress& outer, const Figure& figure, std::size_t index, std::size_t count)
        : outer_(outer), prefix_(fmt::format("{}/{} {}", index + 1, count, figure.name)) {
        outer_.stage(prefix_, 0);
    }
    void stage(std::string_view name, std::size_t total) override {
        outer_.stage(fmt::format("{}: {}", prefix_, name), total);
    }
    void advance(std::size_t done) override { outer_.advance(done); }
    bool cancelled() override { return outer_.cancelled(); }

  private:
    Progress& outer_;
    std::string prefix_;
};

/// DIR/NAME with the figure's files. What it could not make is said at once, and the others go on.
MadeFigure makeFigure(const Figure& figure, const figures::FigureSource& source, const ResultFolder& folder,
                      Progress& progress) {
    const ResultFolder own((folder / figure.name).string());
    MadeFigure made = figures::makeFigure(figure, source, own.path(), progress);
    if (!made.page.empty()) return made;
    wipeProgressLine();
    printError(figure.name + ": " + made.why);
    return made;
}

/// Those that were asked for, and those that lie there from before.
std::vector<MadeFigure> withOlder(const std::vector<MadeFigure>& made, const figures::FigureSource& source,
                                  const ResultFolder& folder) {
    std::vector<MadeFigure> all;
    for (const Figure& figure : figures::figureRegistry()) {
        const auto fresh = std::ranges::find(made, &figure, &MadeFigure::figure);
        if (fresh != made.end())
            all.push_back(*fresh);
        else if (const auto stamp = figures::readStamp(folder / figure.name))
            all.push_back({&figure, figure.name + "/" + stamp->page, "", stamp->claims, stamp->seconds,
                           stamp->source.quick, true, stamp->source.program == source.program});
    }
    return all;
}

void writeIndex(const std::vector<MadeFigure>& made, const figures::FigureSource& source,
                const ResultFolder& folder) {
    const std::vector<MadeFigure> all = withOlder(made, source, folder);
    writeAtomically(folder / "claims.csv", figures::indexCsv(all));
    writeAtomically(folder / "index.html", figures::indexHtml(all));
}

void makeFigures(const FigureArguments& arguments) {
    const auto chosen = chosenFigures(arguments.names);
    const ResultFolder folder(arguments.folder);
    const figures::FigureSource source = figures::thisProgram(arguments.quick);
    std::vector<MadeFigure> made;
    {
        ProgressBar bar(!arguments.quiet && isatty(STDERR_FILENO), interruptFlag());
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            FigureProgress progress(bar, *chosen[i], i, chosen.size());
            made.push_back(makeFigure(*chosen[i], source, folder, progress));
            writeIndex(made, source, folder);  // a run of hours that is interrupted has one, too
        }
    }
    const bool failed = std::ranges::any_of(made, [](const MadeFigure& one) { return one.page.empty(); });
    if (failed) throw ProblemList({}, 1);  // said when it happened
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
    command->add_flag("--quick", arguments->quick, "a small version of everything, in minutes");
    command->add_flag("--quiet", arguments->quiet, "no progress bar, no chatter");
    command->callback([arguments] { makeFigures(*arguments); });
}

}  // namespace edgewise::cli
