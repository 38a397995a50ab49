// Blending: weights times colours, summed in index order (NSAA section 3.3).
#pragma once

#include <functional>
#include <span>

#include "pipeline/image_buffer.h"
#include "pipeline/shade.h"
#include "pipeline/weights.h"

namespace edgewise {

/// The colour of an owner for a sample, over the background where that shows through, and how much of it is
/// not the background's: the mean over the sample + offsets, or at the closest point if there are none.
using ShadeOwner = std::function<Shade(Owner, glm::dvec2 sample_px, std::span<const glm::dvec2> offsets_px)>;

/// Writes the tile's pixels: colour = sum of w c over owners, the background among them; alpha = the sum of w
/// alpha, exact but for one rounding where all alphas are 0 or 1. Weights are never clamped.
void blend(const WeightTile& tile, glm::dvec2 offset_px, const ShadeOwner& shade, ImageBuffer& image);

}  // namespace edgewise
