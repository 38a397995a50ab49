// Blending: weights times colours, summed in index order (NSAA section 3.3).
#pragma once

#include <functional>

#include "pipeline/image_buffer.h"
#include "pipeline/weights.h"

namespace edgewise {

/// The colour of an owner (never the background) for a sample.
using ShadeOwner = std::function<glm::dvec3(Owner, glm::dvec2 sample_px)>;

/// Writes the tile's pixels: colour = sum of w c over owners, the background among them; alpha = the other
/// weights' sum. Weights are never clamped.
void blend(const WeightTile& tile, glm::dvec2 offset_px, const ShadeOwner& shade,
           const glm::dvec3& background, ImageBuffer& image);

}  // namespace edgewise
