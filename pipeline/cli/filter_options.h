// The prefilter as flags.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "analytic/prefilter.h"

namespace edgewise::cli {

/// The flags as typed; an absent one is empty.
struct FilterArguments {
    std::string name = "gaussian";
    std::optional<std::string> radius, sigma;
};

/// Adds --filter, --radius, --sigma.
void addFilterOptions(CLI::App& command, FilterArguments& arguments);
Prefilter readFilter(const FilterArguments& arguments);

}  // namespace edgewise::cli
