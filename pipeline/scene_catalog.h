// From what the user typed as SCENE to a file: a path, a scene of data/, one made on demand, or a model of
// the system.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace edgewise {

/// Where to look. The default is what the program uses; tests set folders of their own.
struct CatalogOptions {
    /// Folders like data/, in order. Default: $EDGEWISE_DATA, ../share/edgewise/data beside the program, and
    /// the data/ of the sources that it was built from.
    std::optional<std::vector<std::filesystem::path>> data_folders;
    /// Where scenes made on demand are kept. Default: $EDGEWISE_CACHE; without it the first that can be
    /// written of $XDG_CACHE_HOME/edgewise, ~/.cache/edgewise and edgewise-UID in the folder for temporary
    /// files.
    std::optional<std::filesystem::path> cache_folder;
    /// Folders that hold assimp/models. Default: $XDG_DATA_HOME and $XDG_DATA_DIRS with their own defaults.
    std::optional<std::vector<std::filesystem::path>> share_folders;
};

/// The file of a scene. An existing file is itself; else a name of sceneNames(), made first if need be: its
/// file appears whole or not at all, and a new generator version makes it anew. Throws InputError for what is
/// neither file nor scene, FailureError when nothing can be written to the cache.
std::filesystem::path findScene(const std::string& scene, const CatalogOptions& options = {});

struct SceneInfo {
    std::string name;
    std::string what;   ///< one line, with the number of triangles
    std::string where;  ///< the file; or how it comes to be: "made on demand", "not found: ..."
};

/// Every scene that has a name in this build, in the contract's order. Makes nothing.
std::vector<SceneInfo> sceneNames(const CatalogOptions& options = {});

}  // namespace edgewise
