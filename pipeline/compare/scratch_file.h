// A file for a moment.
#pragma once

#include <filesystem>

namespace edgewise::compare {

/// A name that no other process has, in a folder that several may share; the file goes away with it. Throws
/// FailureError where none can be made.
class ScratchFile {
  public:
    ScratchFile(const std::filesystem::path& folder, std::size_t index);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace edgewise::compare
