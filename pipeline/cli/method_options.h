// How a picture is made: the method, its device, and what every method understands.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise::cli {

/// The flags as typed; an absent one is empty.
struct MethodArguments {
    std::string device = "auto";
    std::string shading = "closest";
    std::optional<std::string> background, threads, memory, seed, dump_stages;
    std::vector<std::string> no_skip;
};

/// Adds --device, --shading, --background, --threads, --memory, --seed, --no-skip, --dump-stages.
void addMethodOptions(CLI::App& command, MethodArguments& arguments);

RenderOptions readMethodOptions(const MethodArguments& arguments);

/// The folder of --dump-stages exists afterwards.
void makeDumpFolder(const RenderOptions& options);

/// Throws FailureError when --device, or the method's own device=, asks for what this build has not.
void checkDevice(const MethodArguments& arguments, const MethodSpec& method);

}  // namespace edgewise::cli
