// A prefilter as weights' shaders take it.
#pragma once

#include "analytic/edge_integral.h"
#include "pipeline/vulkan/bindings.h"

namespace edgewise::vulkan {

struct WeightKernel {
    WeightKernel(const Prefilter& filter, Precision precision);

    EdgeKernel kernel;
    /// kernel_numbers of shaders/shared/edge_kernel.glsl, as doubles; floats are made of them for kFp32.
    std::vector<double> numbers;
    Specialization constants;  ///< kForm ...
};

}  // namespace edgewise::vulkan
