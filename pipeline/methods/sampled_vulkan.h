// The sampling methods on a Vulkan device.
#pragma once

#include "pipeline/methods/method.h"
#include "pipeline/methods/sample_weights.h"
#include "pipeline/sample_pattern.h"

namespace edgewise {

/// Where samples are resolved, shaded and blended, once the device has rasterized them.
enum class FilterPlace {
    kFastest,  ///< on the device, unless that is a program on the CPU and the support is wide
    kDevice    ///< there, wherever it can
};

/// Scenes that are seen through are made on the CPU, with a note that says so.
MethodResult runSampledVulkan(const MethodInput& in, SamplePattern pattern, SampleWeights weights,
                              FilterPlace place = FilterPlace::kFastest);

}  // namespace edgewise
