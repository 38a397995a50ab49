// Do a tree's values change no faster than its Lipschitz bounds say? Asked of random pairs of points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sdf/field_scene.h"

namespace edgewise::sdf {

/// A node whose value changed faster than its bound.
struct LipschitzViolation {
    std::uint32_t node = 0;
    std::string path;
    double bound = 0.0;             ///< what the node's value may change for a unit of its own frame
    double measured = 0.0;          ///< the steepest pair's slope, less what float's rounding may have added
    std::size_t pairs = 0, of = 0;  ///< that violated it, of those compared
};

struct LipschitzSamples {
    std::uint64_t seed = 1;
    std::size_t pairs = 0;  ///< 0: 4096, fewer for long tapes
};

/// Pairs near and far, in and around the scene's bounds and what its cameras see, half of them moved near the
/// surface. Each node's value is compared in the node's own frame, where all the world's copies of it meet.
/// Allowed is the bound times the distance and both running errors of float. Of nodes within each other the
/// innermost that violates its bound is told, and those with a declared one.
std::vector<LipschitzViolation> checkLipschitz(const FieldScene& scene, const LipschitzSamples& samples = {});

/// As one warning.
std::string wordsOf(const LipschitzViolation& violation);

}  // namespace edgewise::sdf
