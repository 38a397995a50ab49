// How many visible edges each pixel's support holds: what a sampler's rate of convergence depends on.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise {

enum class EdgeClass : std::uint8_t {
    kNoEdge,  ///< no edge
    kFew,     ///< one or two, none parallel to an axis: a stratified sampler's error falls like N^-3/4 there
    kOthers   ///< more, or one parallel to an axis
};

/// By pixel of the film's crop, rows from the top. An edge is a line of which a piece with different owners
/// on its sides (by OwnerClasses) lies in the open square of the filter's radius around the pixel's sample;
/// pieces of one line are one edge. Throws what `nsaa` throws.
std::vector<EdgeClass> edgeClasses(const MethodInput& input);

}  // namespace edgewise
