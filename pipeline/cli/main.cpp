#include <fmt/format.h>
#include <malloc.h>

#include <span>
#include <string>

#include "pipeline/cli/command.h"
#include "pipeline/cli/command_line.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/report.h"
#include "pipeline/error.h"
#include "pipeline/version.h"

namespace edgewise::cli {
namespace {

/// What is freed stays with the program: pages that are given back to the system and asked for again cost
/// more than most stages do with them.
void keepFreedMemory() {
    mallopt(M_MMAP_THRESHOLD, 1 << 25);
    mallopt(M_TRIM_THRESHOLD, 1 << 28);
    mallopt(M_TOP_PAD, 1 << 24);
}

constexpr const char* kFooter = R"(
SCENE is a .gltf, .glb, .sdf.json or .map.glsl file, or the name of a scene: `edgewise scenes` lists them.
An option that takes several values is repeated: --no-skip interior --no-skip empty.

Exit status: 0 done; 1 it failed (device, memory, a stated limit met); 2 the command line or the input is wrong;
130 interrupted. Errors are single lines on standard error: `edgewise: error: WHAT: WHY`.)";

void parseAndRun(int argc, char** argv) {
    const std::string command_line = quoteCommandLine(std::span(argv + 1, argv + argc));
    CLI::App program("Exact analytic antialiasing: closed-form prefilter weights over exact visibility.",
                     "edgewise");
    program.set_version_flag("--version", fmt::format("edgewise {}", version()),
                             "print the version and exit");
    program.set_help_flag("-h,--help", "print this help and exit");
    program.require_subcommand(1);
    program.footer(kFooter);
    addRender(program, command_line);
    addCompare(program, command_line);
    addCompareWorker(program);
    addSweep(program);
    addMerge(program);
    addWeights(program);
    addMetrics(program);
    addPost(program, command_line);
    addPolygonize(program, command_line);
    addInfo(program);
    addMethods(program);
    addFilters(program);
    addScenes(program);
    addFigure(program);
    addFigures(program);
#ifdef EDGEWISE_HAS_ORACLE
    addStability(program, command_line);
#endif
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        program.exit(help_or_version);
    } catch (const CLI::RequiredError&) {
        // "A subcommand is required" is no help to who misspelt one.
        if (const auto unknown = program.remaining(); !unknown.empty())
            throw InputError(unknown.front(), "is no command; `edgewise --help` lists them");
        throw;
    }
}

}  // namespace
}  // namespace edgewise::cli

int main(int argc, char** argv) {
    using namespace edgewise::cli;
    keepFreedMemory();
    logToStandardError();
    catchInterrupts();
    return runAndReport([&] { parseAndRun(argc, argv); });
}
