// A prefilter as weights' shaders take it.
#pragma once

#include <optional>
#include <string>

#include "analytic/edge_integral.h"
#include "pipeline/vulkan/bindings.h"

namespace edgewise::vulkan {

/// Why the shaders cannot weigh with a filter, in words; nullopt: they can.
std::optional<std::string> whyNotWeighed(const Prefilter& filter);

struct WeightKernel {
    WeightKernel(const Prefilter& filter, Precision precision);

    EdgeKernel kernel;
    /// The numbers of shaders/shared/edge_kernel.glsl, as doubles; floats are made of them for kFp32.
    std::vector<double> numbers;
    Specialization constants;  ///< kForm ...
};

}  // namespace edgewise::vulkan
