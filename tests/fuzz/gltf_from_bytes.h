// Any bytes as a glTF file, so that few of them are wasted on a container's lengths.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/scene.h"

namespace edgewise::fuzz {

/// Bytes that start with '{' are JSON up to the first zero byte and a binary chunk after it: they become a
/// GLB with right lengths, or, without a zero byte, a .gltf. Other bytes are a file as they are.
std::string gltfFromBytes(std::span<const std::uint8_t> bytes);

/// Loads the file made of the bytes, at a time of its first animation if it has one, with small limits.
Scene loadBytes(std::span<const std::uint8_t> bytes);

/// Whatever the bytes are, loading ends in a scene whose numbers are finite and whose indices are in range,
/// or in one of the two errors of the world. Empty, or what is wrong in words.
std::string checkLoad(std::span<const std::uint8_t> bytes);

}  // namespace edgewise::fuzz
