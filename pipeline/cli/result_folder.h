// The folder of a command's results.
#pragma once

#include <filesystem>
#include <string>

namespace edgewise::cli {

/// Made where it is not there; one that this run made and left empty goes away with it.
class ResultFolder {
  public:
    /// Throws InputError "OPTION: WHY" for what is no folder that may be written to.
    explicit ResultFolder(const std::string& name, const std::string& option = "-o");
    ~ResultFolder();
    ResultFolder(const ResultFolder&) = delete;
    ResultFolder& operator=(const ResultFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& file) const { return path_ / file; }

  private:
    std::filesystem::path path_;
    bool made_ = false;
};

}  // namespace edgewise::cli
