#include <fmt/format.h>

#include "analytic/prefilter.h"
#include "pipeline/cli/command.h"

namespace edgewise::cli {

void addFilters(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("filters", "the filters of this build, one a line, with parameters");
    acceptQuiet(*command);
    command->callback([] {
        for (const std::string& line : describePrefilters()) fmt::print("{}\n", line);
    });
}

}  // namespace edgewise::cli
