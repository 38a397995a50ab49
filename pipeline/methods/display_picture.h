// A picture as a filter of the display's signal reads it: sRGB-encoded.
#pragma once

#include <glm/vec3.hpp>

#include "pipeline/image_buffer.h"
#include "pipeline/methods/texels.h"

namespace edgewise {

using EncodedPicture = Texels<glm::vec3>;

/// sRGB-encoded colours. The curve goes on beyond [0, 1], so that a colour brighter than white comes back.
EncodedPicture encodePicture(const ImageBuffer& image);

/// What an 8-bit target keeps of an encoded colour, in [0, 1].
glm::vec3 quantized(const glm::vec3& encoded);

/// Weighted sums of the quantised colours' channels.
Texels<float> lumaOf(const EncodedPicture& picture, const glm::vec3& weights);

}  // namespace edgewise
