// How a picture is made: the method, its device, and what every method understands.
#pragma once

#include <oneapi/tbb/global_control.h>

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise::cli {

/// The flags as typed; an absent one is empty.
struct MethodArguments {
    std::string device = "auto";
    std::string precision = "fp64";
    std::string shading = "closest";
    std::optional<std::string> background, threads, memory, seed, frames;
    std::vector<std::string> no_skip;
};

/// Adds --device, --precision, --shading, --background, --threads, --memory, --seed, --frames, --no-skip.
void addMethodOptions(CLI::App& command, MethodArguments& arguments);

RenderOptions readMethodOptions(const MethodArguments& arguments);

/// Without --background an SDF scene's own.
void takeBackground(const MethodArguments& arguments, const Scene& scene, RenderOptions& options);

/// While it lives, no more threads work than --threads says.
class ThreadLimit {
  public:
    explicit ThreadLimit(const RenderOptions& options);

  private:
    std::optional<tbb::global_control> control_;
};

/// Throws FailureError when --device or the method's own device= ask for what this build has
/// not, or --shading for what the method has not.
void checkAbilities(const MethodArguments& arguments, const MethodSpec& method);

}  // namespace edgewise::cli
