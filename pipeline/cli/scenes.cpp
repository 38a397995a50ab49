#include <fmt/format.h>

#include "pipeline/cli/command.h"
#include "pipeline/scene_catalog.h"

namespace edgewise::cli {

void addScenes(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("scenes", "the scenes that have a name, one a line, and where they are");
    acceptQuiet(*command);
    command->callback([] {
        for (const SceneInfo& scene : sceneNames())
            fmt::print("{:<16} {} ({})\n", scene.name, scene.what, scene.where);
    });
}

}  // namespace edgewise::cli
