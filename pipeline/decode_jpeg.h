// JPEG by OpenImageIO.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/picture_samples.h"

namespace edgewise {

/// Decodes a JPEG to grey or RGB. Throws InputError naming `what`.
PictureSamples decodeJpeg(std::span<const std::uint8_t> jpeg, const SizeCheck& check_size,
                          const std::string& what);

}  // namespace edgewise
