#include "pipeline/scene_folders.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "pipeline/atomic_file.h"

namespace edgewise {
namespace {

namespace fs = std::filesystem;

/// The variable's value; an empty one counts as unset.
std::optional<std::string> environment(const char* name) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') return std::nullopt;
    return value;
}

std::vector<fs::path> splitPathList(const std::string& list) {
    std::vector<fs::path> folders;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(':', begin), list.size());
        if (end > begin) folders.emplace_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return folders;
}

}  // namespace

std::vector<fs::path> defaultDataFolders() {
    std::vector<fs::path> folders;
    if (const auto folder = environment("EDGEWISE_DATA")) folders.emplace_back(*folder);
    std::error_code none;
    const fs::path program = fs::read_symlink("/proc/self/exe", none);
    if (!none) folders.push_back(program.parent_path().parent_path() / "share/edgewise/data");
    folders.emplace_back(EDGEWISE_SOURCE_DATA);
    return folders;
}

std::vector<fs::path> defaultCacheFolders() {
    if (const auto folder = environment("EDGEWISE_CACHE")) return {*folder};
    std::vector<fs::path> folders;
    if (const auto cache = environment("XDG_CACHE_HOME")) folders.push_back(fs::path(*cache) / "edgewise");
    if (const auto home = environment("HOME")) folders.push_back(fs::path(*home) / ".cache/edgewise");
    std::error_code none;
    const fs::path temporary = fs::temp_directory_path(none);
    if (!none) folders.push_back(temporary / ("edgewise-" + std::to_string(::getuid())));
    return folders;
}

std::vector<fs::path> defaultShareFolders() {
    std::vector<fs::path> folders;
    const auto home = environment("HOME");
    if (const auto own = environment("XDG_DATA_HOME"))
        folders.emplace_back(*own);
    else if (home)
        folders.push_back(fs::path(*home) / ".local/share");
    const std::string list = environment("XDG_DATA_DIRS").value_or("") + ":/usr/local/share:/usr/share";
    for (const fs::path& folder : splitPathList(list)) folders.push_back(folder);
    return folders;
}

std::optional<fs::path> findBelow(const fs::path& folder, const fs::path& usual) {
    std::error_code error;
    if (fs::is_regular_file(folder / usual, error)) return folder / usual;
    std::vector<fs::path> found;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
        std::error_code unreadable;
        if (entry->path().filename() == usual.filename() && entry->is_regular_file(unreadable)) {
            found.push_back(entry->path());
        }
    }
    if (found.empty()) return std::nullopt;
    return *std::min_element(found.begin(), found.end());
}

bool writeWhole(const fs::path& path, const std::string& bytes) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) return false;
    try {
        writeAtomically(path, bytes);
    } catch (const std::runtime_error&) {
        return false;
    }
    return true;
}

}  // namespace edgewise
