// Outputs appear whole or not at all: written under a temporary name in the same folder, then renamed.
#pragma once

#include <cstddef>
#include <cstdio>
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

/// A file under a temporary name beside its target: gone unless it is kept. At most kMaxPendingFiles at once.
class PendingFile {
  public:
    /// Throws InputError as checkOutputPath does, FailureError when it cannot be made.
    explicit PendingFile(const std::filesystem::path& target);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    std::FILE* stream() const { return stream_; }

    /// It takes the target's name. Throws FailureError where anything that was written did not arrive.
    void keep();

  private:
    std::filesystem::path target_;
    std::size_t slot_;
    std::filesystem::path name_;
    std::FILE* stream_ = nullptr;
    bool kept_ = false;
};

inline constexpr std::size_t kMaxPendingFiles = 64;

/// Removes the temporary files of writes under way. Safe in a signal handler; the process must end
/// afterwards.
void removePendingFile() noexcept;

}  // namespace edgewise
