// --aov: more channels in the EXR.
#pragma once

#include <CLI/App.hpp>
#include <set>
#include <string>
#include <vector>

#include "pipeline/aov_names.h"

namespace edgewise::cli {

void addAovOptions(CLI::App& command, std::vector<std::string>& names);

/// Throws InputError for a name that is none, and where no output could hold the channels: a PNG beside an
/// EXR does without them, PNGs alone would lose them.
std::set<Aov> readAovs(const std::vector<std::string>& names, const std::vector<std::string>& outputs);

}  // namespace edgewise::cli
