#include <fmt/format.h>

#include "paper_figures/figure.h"
#include "pipeline/cli/command.h"

namespace edgewise::cli {

void addFigures(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("figures", "the figures and tables that this build can make, one a line");
    acceptQuiet(*command);
    command->callback([] {
        for (const figures::Figure& figure : figures::figureRegistry())
            fmt::print("{}: {} ({})\n", figure.name, figure.what, figure.source);
    });
}

}  // namespace edgewise::cli
