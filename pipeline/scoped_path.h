// Files and folders for a while.
#pragma once

#include <filesystem>

namespace edgewise {

/// A file, or a folder with all that is in it, that goes away with this value.
class ScopedPath {
  public:
    explicit ScopedPath(std::filesystem::path path) : path_(std::move(path)) {}
    ~ScopedPath();
    ScopedPath(const ScopedPath&) = delete;
    ScopedPath& operator=(const ScopedPath&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// A folder among the system's temporary ones, of a name that no other process has. Throws FailureError.
ScopedPath temporaryFolder();

/// A folder with nothing in it, whatever was there before; nothing where it cannot be made.
ScopedPath emptyFolder(const std::filesystem::path& path);

/// A file with nothing in it, in a folder that several may share, of a name that no other process has. Throws
/// FailureError.
ScopedPath temporaryFile(const std::filesystem::path& folder);

}  // namespace edgewise
