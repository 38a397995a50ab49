#include "pipeline/scene_catalog.h"

#include <fmt/format.h>

#include <algorithm>

#include "data/generate/recipes.h"
#include "pipeline/error.h"
#include "pipeline/scene_folders.h"
#include "sdf/nearest_name.h"

namespace edgewise {
namespace {

namespace fs = std::filesystem;
using scenes::Recipe;

constexpr const char* kEngine = "engine";
constexpr const char* kEngineFile = "2CylinderEngine-glTF-Binary/2CylinderEngine.glb";
constexpr const char* kEngineHint = "2CylinderEngine.glb comes with Debian's package assimp-testmodels";

bool isFile(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// In the contract's order.
std::vector<const Recipe*> allRecipes() {
    std::vector<const Recipe*> all;
    for (const auto* recipes : {&scenes::namedRecipes(), &scenes::sdfRecipes()})
        for (const Recipe& recipe : *recipes) all.push_back(&recipe);
    return all;
}

const Recipe* findRecipe(const std::string& name) {
    const auto recipes = allRecipes();
    const auto found =
        std::find_if(recipes.begin(), recipes.end(), [&](const Recipe* r) { return r->name == name; });
    return found == recipes.end() ? nullptr : *found;
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
    if (!recipe.bytes) throw InputError(recipe.name, "its file is in no data folder; set EDGEWISE_DATA");
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

/// "did you mean NAME?" where a third of the letters or fewer are wrong.
std::string hint(const std::string& scene) {
    const std::string list = "`edgewise scenes` lists the names";
    std::vector<std::string_view> names{kEngine};
    for (const Recipe* recipe : allRecipes()) names.push_back(recipe->name);
    const auto best = sdf::nearestName(scene, names);
    return best ? fmt::format("did you mean {}? {}", *best, list) : list;
}

[[noreturn]] void refuse(const std::string& scene) {
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
    const auto add = [&](const Recipe& recipe, const std::string& what) {
        const auto file = existingFile(recipe, options);
        const char* const absent = recipe.bytes ? "made on demand" : "not found: in no data folder";
        names.push_back({recipe.name, what, file ? file->string() : absent});
    };
    for (const Recipe& recipe : scenes::namedRecipes())
        add(recipe, fmt::format("{} ({} triangles)", recipe.what, recipe.triangles));
    const auto engine = findEngine(options);
    names.push_back({kEngine, "a two-cylinder engine, a real model of many parts (121,496 triangles)",
                     engine ? engine->string() : std::string("not found: ") + kEngineHint});
    for (const Recipe& recipe : scenes::sdfRecipes()) add(recipe, recipe.what);
    return names;
}

}  // namespace edgewise
