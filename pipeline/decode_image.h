// PNG, JPEG and WebP bytes to linear texels.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/picture_samples.h"
#include "pipeline/scene.h"

namespace edgewise {

/// True if the first bytes are a PNG's, a JPEG's or a WebP's.
bool isKnownPicture(std::span<const std::uint8_t> bytes);

/// What the numbers of a picture's colours mean; alpha is linear and straight either way.
enum class ColorEncoding { kSrgb, kLinear };

/// Decodes 8- and 16-bit PNG, JPEG and WebP. Throws InputError naming `what`, also for a picture that claims
/// more texels than its bytes can hold; FailureError past max_texels.
PictureSamples decodeSamples(std::span<const std::uint8_t> bytes, std::uint64_t max_texels,
                             const std::string& what);

/// The same, linear. Grey becomes RGB, a missing alpha 1. Colour profiles and orientation tags are ignored,
/// as glTF asks.
Image decodeImage(std::span<const std::uint8_t> bytes, ColorEncoding encoding, std::uint64_t max_texels,
                  const std::string& what);

}  // namespace edgewise
