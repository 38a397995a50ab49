// A PNG writer for textures of a few texels: stored blocks, so the bytes depend on no compressor.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace edgewise::scenes {

using Rgb8 = std::array<std::uint8_t, 3>;

/// The bytes of an 8-bit RGB PNG, row 0 on top; at most 65,535 bytes of rows.
std::string pngBytes(int width, int height, const std::vector<Rgb8>& texels);

}  // namespace edgewise::scenes
