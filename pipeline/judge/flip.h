// LDR-FLIP, the difference that a viewer sees who flips between two pictures. Source: Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astrom, Fairchild 2020, 'FLIP: A Difference Evaluator for Alternating Images'.
#pragma once

#include <vector>

#include "pipeline/image_buffer.h"

namespace edgewise::judge {

/// Pixels a degree of the viewer's field: a 0.7 m wide display of 3840 pixels, seen from 0.7 m. The published
/// implementation's default is 67.02; means differ by less than 1e-4.
inline constexpr double kFlipPixelsPerDegree = 67.0;

/// FLIP of each pixel, rows from the top, in [0, 1]: 0 where the pictures look alike. Both have the same
/// size. On the sRGB picture: R, G, B clamped to [0, 1], not rounded to 8 bits; the encoding itself cancels,
/// since FLIP decodes it first. The values must be finite.
///
/// Colour: luminance, red-green and blue-yellow are blurred by what the eye resolves of them, clamped to the
/// RGB cube, and compared by HyAB in L*a*b* with Hunt's effect, to the power 0.7, mapped to [0, 1] so that
/// 0.4 of the largest (green against blue) becomes 0.95. Features: edges and points of the luminance, by a
/// Gaussian's first and second derivatives; the larger change, f in [0, 1]. FLIP = colour^(1 - sqrt(f)).
/// Beyond their border pictures go on with the border's values.
std::vector<double> flipMap(const ImageBuffer& image, const ImageBuffer& reference);

}  // namespace edgewise::judge
