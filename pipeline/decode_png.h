// PNG by its own library: through OpenImageIO 2.4 it writes its errors to standard error by itself.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/picture_samples.h"

namespace edgewise {

/// Decodes a PNG of any kind: palettes become RGB, transparent colours alpha, fewer than 8 bits 8. Throws
/// InputError naming `what`.
PictureSamples decodePng(std::span<const std::uint8_t> png, const SizeCheck& check_size,
                         const std::string& what);

}  // namespace edgewise
