// --exposure: how bright PNGs are.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

namespace edgewise::cli {

void addExposureOption(CLI::App& command, std::optional<std::string>& text);

/// In EV; 0 where nothing is typed. Throws InputError "--exposure: WHY".
double readExposure(const std::optional<std::string>& text);

}  // namespace edgewise::cli
