// A folder for what is on its way.
#pragma once

#include <filesystem>

namespace edgewise::figures {

/// Goes away with this value. Throws FailureError where it cannot be made.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace edgewise::figures
