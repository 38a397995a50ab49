// A file whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace edgewise {

/// A stated limit. tinygltf and the image decoder take sizes as int, hence this one.
inline constexpr std::uint64_t kMaxFileBytes = 0x7fffffff;

/// Throws InputError naming `what` unless there is a regular file.
void needRegularFile(const std::filesystem::path& path, const std::string& what);

/// A regular file's bytes. Throws InputError naming `what`; FailureError when it is larger than
/// kMaxFileBytes.
std::vector<std::uint8_t> readWholeFile(const std::filesystem::path& path, const std::string& what);

/// The same as text, named by its path.
std::string readText(const std::filesystem::path& path);

}  // namespace edgewise
