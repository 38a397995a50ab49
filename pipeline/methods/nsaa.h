// The analytic pipeline, and its weights for those who want to look at a pixel.
#pragma once

#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise {

/// One owner of a pixel.
struct PixelOwner {
    std::uint32_t index;  ///< the contract's triangle index
    double weight;
    glm::dvec3 color;
};

struct PixelReport {
    std::vector<PixelOwner> owners;  ///< ascending index
    double background = 0.0;         ///< its own integral
    double sum = 0.0;                ///< of all weights, summed exactly and rounded once
};

/// The exact weights of one pixel of the film; every owner stands for itself.
PixelReport pixelWeights(const MethodInput& input, int x, int y);

}  // namespace edgewise
