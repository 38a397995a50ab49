// The parts of a PNG that make its pixels.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace edgewise {

/// A PNG (its signature already recognised) reduced to IHDR, PLTE, tRNS, IDAT and IEND, each with its
/// checksum verified. glTF ignores the rest (profiles, gamma), and libpng writes about it to standard error
/// by itself. Throws InputError naming `what` for a chunk that is cut off or damaged.
std::vector<std::uint8_t> pixelChunks(std::span<const std::uint8_t> png, const std::string& what);

}  // namespace edgewise
