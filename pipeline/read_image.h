// A finished picture from disk, as write_image or another program left it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "pipeline/image_buffer.h"

namespace edgewise {

/// Pixels that a picture may have; 16384 x 16384.
inline constexpr std::uint64_t kMaxPicturePixels = std::uint64_t{1} << 28;

/// EXR: channels R, G, B as they are, or Y for all three; the box is the data window; `edge` is empty if the
/// file has no channel of that name. PNG (JPEG, WebP) of 8 or 16 bits: sRGB-decoded in double; the box begins
/// at 0,0; no `edge`. A missing alpha is 1. Values are not checked. Throws InputError for a file that cannot
/// be read or is something else, FailureError past kMaxPicturePixels; both name the file.
ImageBuffer readImage(const std::filesystem::path& path);

}  // namespace edgewise
