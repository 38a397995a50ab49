// The oracle's view of a picture: weights from exact faces, for those who doubt a pixel.
#pragma once

#include <string>
#include <vector>

#include "analytic/layer_stacks.h"
#include "pipeline/methods/method.h"

namespace edgewise {

/// More triangles than this around the film's crop are refused: the envelope would take minutes.
inline constexpr std::size_t kMaxOracleTriangles = 5000;

/// An owner's weight as the oracle has it.
struct ExactWeight {
    Owner owner;
    std::string digits;    ///< 32 significant digits
    double nearest = 0.0;  ///< the nearest double
    double ulp_off = 0.0;  ///< what the product's weight is off, in units of the last place of the exact one
};

/// The oracle's weights of one pixel by ascending owner, the background last, beside `product` (owner,
/// weight) of the same pixel. Throws FailureError where the oracle cannot judge: see-through triangles, too
/// many triangles.
std::vector<ExactWeight> exactWeights(const MethodInput& input, int x, int y,
                                      const std::vector<std::pair<Owner, double>>& product);

}  // namespace edgewise
