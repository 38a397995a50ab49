// Where a picture differs from its reference, in colours of fixed scales: maps of different rows compare.
#pragma once

#include <string>
#include <vector>

#include "pipeline/image_buffer.h"

namespace edgewise::compare {

/// Decades of error that the maps' colours span; what is less is their ground colour.
inline constexpr double kLeastShown = 1e-5, kMostShown = 1.0;

/// PNG of the mean signed error over R, G, B: blue where the picture is darker, red where it is lighter, log
/// in size. The pictures have one box.
std::vector<unsigned char> signedErrorMap(const ImageBuffer& image, const ImageBuffer& reference);
/// PNG of the largest absolute error of R, G, B, log.
std::vector<unsigned char> absoluteErrorMap(const ImageBuffer& image, const ImageBuffer& reference);

/// The colour bars as CSS gradients from left to right: -kMostShown to kMostShown, and kLeastShown to
/// kMostShown.
std::string signedGradient();
std::string absoluteGradient();

}  // namespace edgewise::compare
