// Names for contents: 128 bits of xxHash's XXH3 as 32 hexadecimal digits, the same on every machine.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace edgewise::sweep {

std::string contentHash(std::string_view bytes);

/// Of a scene's file and, for glTF, of every file that it refers to. Throws InputError for what cannot be
/// read.
std::string sceneHash(const std::filesystem::path& path);

}  // namespace edgewise::sweep
