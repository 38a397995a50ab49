#include "pipeline/methods/method.h"

#include <fmt/format.h>

#include "pipeline/cli/command.h"

namespace edgewise::cli {

void addMethods(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("methods", "the methods of this build, one a line, with parameters");
    acceptQuiet(*command);
    command->callback([] {
        for (const std::string& line : describeMethods()) fmt::print("{}\n", line);
    });
}

}  // namespace edgewise::cli
