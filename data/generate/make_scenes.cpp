// make_scenes FOLDER: rewrites every file of data/ that ships.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "data/generate/recipes.h"
#include "sdf/sdf_schema.h"

namespace {

void write(const std::filesystem::path& path, const std::string& bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": cannot be written");
    std::cout << path.string() << ": " << bytes.size() << " bytes\n";
}

void writeAll(const std::filesystem::path& folder) {
    for (const auto* recipes : {&edgewise::scenes::namedRecipes(), &edgewise::scenes::sdfRecipes(),
                                &edgewise::scenes::degenerateRecipes()}) {
        for (const auto& recipe : *recipes) {
            if (recipe.ships && recipe.bytes) write(folder / recipe.file, recipe.bytes());
        }
    }
    write(folder / "MANIFEST.md", edgewise::scenes::manifest());
    write(folder / "sdf.schema.json", edgewise::sdf::schemaText());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: make_scenes FOLDER\n";
        return 2;
    }
    try {
        writeAll(argv[1]);
    } catch (const std::exception& problem) {
        std::cerr << "make_scenes: error: " << problem.what() << '\n';
        return 1;
    }
    return 0;
}
