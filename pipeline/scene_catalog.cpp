#include "pipeline/scene_catalog.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "data/generate/recipes.h"
#include "pipeline/error.h"
#include "pipeline/scene_folders.h"

namespace edgewise {
namespace {

namespace fs = std::filesystem;
using scenes::Recipe;

constexpr const char* kEngine = "engine";
constexpr const char* kEngineFile = "2CylinderEngine-glTF-Binary/2CylinderEngine.glb";
constexpr const char* kEngineHint = "2CylinderEngine.glb comes with Debian's package assimp-testmodels";

/// The contract's SDF scenes: named here only so that asking for one gets a plain answer.
constexpr std::array kSdfScenes = {
    "primitives", "random-box",       "random-shape", "sparse-shape", "atrium", "jewel",
    "city",       "path-room",        "convex",       "thin",         "blob",   "gyroid",
    "menger-3",   "sphere-minus-box", "spheres-50",   "spheres-1000", "wires",  "slabs"};

bool isFile(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

const Recipe* findRecipe(const std::string& name) {
    const auto& recipes = scenes::namedRecipes();
    const auto found =
        std::find_if(recipes.begin(), recipes.end(), [&](const Recipe& r) { return r.name == name; });
    return found == recipes.end() ? nullptr : &*found;
}

std::vector<fs::path> cacheFiles(const Recipe& recipe, const CatalogOptions& options) {
    const auto folders = options.cache_folder ? std::vector{*options.cache_folder} : defaultCacheFolders();
    std::vector<fs::path> files;
    for (const fs::path& folder : folders)
        files.push_back(folder / ("scenes-" + scenes::generatorVersion()) / recipe.file);
    return files;
}

/// A shipped file in a data folder, or one made before.
std::optional<fs::path> existingFile(const Recipe& recipe, const CatalogOptions& options) {
    std::vector<fs::path> files;
    for (const fs::path& folder : options.data_folders.value_or(defaultDataFolders()))
        files.push_back(folder / recipe.file);
    const std::vector<fs::path> cached = cacheFiles(recipe, options);
    files.insert(files.end(), cached.begin(), cached.end());
    const auto found = std::find_if(files.begin(), files.end(), isFile);
    return found == files.end() ? std::nullopt : std::optional(*found);
}

fs::path makeScene(const Recipe& recipe, const CatalogOptions& options) {
    const std::string bytes = recipe.bytes();
    const std::vector<fs::path> files = cacheFiles(recipe, options);
    for (const fs::path& file : files) {
        if (writeWhole(file, bytes)) return file;
    }
    const std::string tried = files.empty() ? "no folder for it" : files.front().parent_path().string();
    throw FailureError(recipe.name,
                       fmt::format("cannot be made: {}: cannot be written; set EDGEWISE_CACHE", tried));
}

std::optional<fs::path> findEngine(const CatalogOptions& options) {
    for (const fs::path& share : options.share_folders.value_or(defaultShareFolders())) {
        if (const auto file = findBelow(share / "assimp/models/glTF2", kEngineFile)) return file;
    }
    return std::nullopt;
}

/// Levenshtein's distance, one row at a time.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

/// "did you mean NAME?" where a third of the letters or fewer are wrong.
std::string hint(const std::string& scene) {
    const std::string list = "`edgewise scenes` lists the names";
    if (scene.size() > 64) return list;
    std::string best = kEngine;
    for (const Recipe& recipe : scenes::namedRecipes()) {
        if (editDistance(scene, recipe.name) < editDistance(scene, best)) best = recipe.name;
    }
    return 3 * editDistance(scene, best) <= best.size() ? fmt::format("did you mean {}? {}", best, list)
                                                        : list;
}

[[noreturn]] void refuse(const std::string& scene) {
    if (std::find(kSdfScenes.begin(), kSdfScenes.end(), scene) != kSdfScenes.end()) {
        throw InputError(scene, "an SDF scene, which this build does not have");
    }
    std::error_code error;
    if (fs::is_directory(scene, error)) throw InputError(scene, "a folder, not a scene file");
    const std::string missing = "no such file or scene";
    throw InputError(scene.empty() ? "SCENE" : scene,
                     scene == kEngine ? missing + "; " + kEngineHint : missing + "; " + hint(scene));
}

}  // namespace

fs::path findScene(const std::string& scene, const CatalogOptions& options) {
    if (isFile(scene)) return scene;
    if (const Recipe* recipe = findRecipe(scene)) {
        const auto file = existingFile(*recipe, options);
        return file ? *file : makeScene(*recipe, options);
    }
    if (scene == kEngine) {
        if (const auto file = findEngine(options)) return *file;
    }
    refuse(scene);
}

std::vector<SceneInfo> sceneNames(const CatalogOptions& options) {
    std::vector<SceneInfo> names;
    for (const Recipe& recipe : scenes::namedRecipes()) {
        const auto file = existingFile(recipe, options);
        names.push_back({recipe.name, fmt::format("{} ({} triangles)", recipe.what, recipe.triangles),
                         file ? file->string() : "made on demand"});
    }
    const auto engine = findEngine(options);
    names.push_back({kEngine, "a two-cylinder engine, a real model of many parts (121,496 triangles)",
                     engine ? engine->string() : std::string("not found: ") + kEngineHint});
    return names;
}

}  // namespace edgewise
