// Any bytes as an SDF scene's text.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace edgewise::fuzz {

/// Whatever the bytes are, reading them as a .sdf.json ends in a scene that can be traced, its numbers
/// finite, or in a SceneError of one line. Empty, or what is wrong in words.
std::string checkSdf(std::span<const std::uint8_t> bytes);

/// The same of a .map.glsl's header.
std::string checkMap(std::span<const std::uint8_t> bytes);

}  // namespace edgewise::fuzz
