// The subcommands: each lives in the file of its name and adds itself to the program.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>

namespace edgewise::cli {

/// `command_line` is what the user typed, for the metadata of outputs.
void addRender(CLI::App& program, const std::string& command_line);
void addCompare(CLI::App& program, const std::string& command_line);
void addCompareWorker(CLI::App& program);  ///< what compare runs, one a method; not for users
void addSweep(CLI::App& program);
void addMerge(CLI::App& program);
void addWeights(CLI::App& program);
void addMetrics(CLI::App& program);
void addPost(CLI::App& program, const std::string& command_line);
void addPolygonize(CLI::App& program, const std::string& command_line);
void addInfo(CLI::App& program);
void addMethods(CLI::App& program);
void addFilters(CLI::App& program);
void addScenes(CLI::App& program);
void addFigure(CLI::App& program);
void addFigures(CLI::App& program);
void addStability(CLI::App& program, const std::string& command_line);  ///< with the oracle

/// --quiet, of a command that draws no bar and says only what it is asked for.
inline void acceptQuiet(CLI::App& command) {
    command.add_flag("--quiet")->description("no progress bar, no chatter: there is none");
}

}  // namespace edgewise::cli
