#include "data/generate/gltf_file.h"
#include "data/generate/recipes.h"

namespace edgewise::scenes {
namespace {

std::string row(const Recipe& recipe) {
    return "| `" + recipe.file + "` | " + recipe.what + " | " + std::to_string(recipe.triangles) + " | " +
           std::to_string(recipe.width_px) + " x " + std::to_string(recipe.height_px) + " | " +
           (recipe.ships ? "this folder" : "made on demand") + " |\n";
}

std::string sdfRow(const Recipe& recipe) {
    return "| `" + recipe.file + "` | " + recipe.what + " | " + std::to_string(recipe.width_px) + " x " +
           std::to_string(recipe.height_px) + " | " +
           (recipe.bytes ? "`data/generate/`" : "by hand, the project's own") + " | " +
           (recipe.ships ? "this folder" : "made on demand") + " |\n";
}

std::string sdfTable() {
    std::string text =
        "| file | what it shows | made for, px | made by | lies in |\n| --- | --- | --- | --- | --- |\n";
    for (const Recipe& recipe : sdfRecipes()) text += sdfRow(recipe);
    return text;
}

std::string table(const std::vector<Recipe>& recipes) {
    std::string text =
        "| file | what it shows | triangles | made for, px | lies in |\n| --- | --- | --- | --- | --- |\n";
    for (const Recipe& recipe : recipes) text += row(recipe);
    return text;
}

}  // namespace

std::string generatorVersion() {
    return std::to_string(kGeneratorVersion);
}

std::string manifest() {
    return "# Scenes that ship\n\n"
           "Origin: every scene of this folder, but for SDF scenes written by hand, is made by `make_scenes` "
           "from "
           "the code in `data/generate/`, whose "
           "headers say how each pattern is constructed; nothing comes from elsewhere. Licence: the "
           "project's own. "
           "The bytes are the same on every machine, and a test compares them. This page is made with them "
           "(generator "
           "version " +
           generatorVersion() +
           ").\n\n"
           "## Named scenes\n\n" +
           table(namedRecipes()) +
           "\nThe scene `engine` is not ours and not here: `2CylinderEngine.glb` of Debian's package "
           "assimp-testmodels, found where that package puts it, under that package's licence.\n\n"
           "## SDF scenes\n\nBy `sdf.schema.json`, which edgewise makes of its own tables. Those made by "
           "hand "
           "are the project's own too, after descriptions in words: nothing is copied.\n\n" +
           sdfTable() +
           "\n## Degenerate scenes, for tests\n\nUnlit, a colour a triangle, linear values in [0, 1]; opened "
           "by their "
           "path.\n\n" +
           table(degenerateRecipes());
}

}  // namespace edgewise::scenes
