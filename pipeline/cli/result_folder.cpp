#include "pipeline/cli/result_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include "pipeline/error.h"

namespace edgewise::cli {

ResultFolder::ResultFolder(const std::string& name, const std::string& option) : path_(name) {
    std::error_code error;
    made_ = std::filesystem::create_directories(path_, error);
    if (!std::filesystem::is_directory(path_, error))
        throw InputError(option, fmt::format("{} is not a folder and cannot be made one", name));
    // Said before the work, not after it.
    if (access(path_.c_str(), W_OK | X_OK) != 0)
        throw InputError(option, fmt::format("{} may not be written to", name));
}

ResultFolder::~ResultFolder() {
    std::error_code error;
    if (made_) std::filesystem::remove(path_, error);  // fails where something is in it, as it should
}

}  // namespace edgewise::cli
