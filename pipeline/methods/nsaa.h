// The analytic pipeline, and its weights for those who want to look at a pixel.
#pragma once

#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise {

/// What a triangle gives to a pixel where one stack of layers lies over it: weight times colour.
struct PixelOwner {
    std::uint32_t index;  ///< the contract's triangle index
    double
        weight;  ///< of the stack's visible part, times what its layers in front let through, times its alpha
    glm::dvec3 color;
    std::vector<std::uint32_t> layers;  ///< the triangles in front of it, front to back, then itself
};

struct PixelReport {
    std::vector<PixelOwner> owners;  ///< opaque ones by ascending index, then stack by stack
    double background = 0.0;         ///< its own integral, and what stacks let through to it
    double sum = 0.0;                ///< of all weights, summed exactly and rounded once
};

/// The exact weights of one pixel of the film; every owner stands for itself.
PixelReport pixelWeights(const MethodInput& input, int x, int y);

/// The same on a device; with Vulkan.
PixelReport pixelWeightsVulkan(const MethodInput& input, int x, int y);

}  // namespace edgewise
