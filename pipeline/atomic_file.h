// Outputs appear whole or not at all: written under a temporary name in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace edgewise {

/// Throws InputError when `path` cannot name an output: it is empty or a folder, or its folder does not
/// exist.
void checkOutputPath(const std::filesystem::path& path);

/// Replaces `path` by a file of these bytes. A device or a pipe is written to as it is.
/// Throws InputError as checkOutputPath does, FailureError when the system refuses (permission, full disk).
void writeAtomically(const std::filesystem::path& path, std::span<const unsigned char> bytes);
void writeAtomically(const std::filesystem::path& path, std::string_view text);

/// Removes the temporary file of a write under way. Safe in a signal handler; the process must end
/// afterwards.
void removePendingFile() noexcept;

}  // namespace edgewise
