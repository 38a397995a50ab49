// WebP by its own library: OpenImageIO 2.4's reader multiplies colours by alpha, whatever it is asked.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/picture_samples.h"

namespace edgewise {

/// Decodes a still WebP, lossy or lossless, to RGBA. Throws InputError naming `what` for damage and for
/// animations.
PictureSamples decodeWebp(std::span<const std::uint8_t> webp, const SizeCheck& check_size,
                          const std::string& what);

}  // namespace edgewise
