// Every scene this project makes: its name, its file, and the function that makes its bytes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace edgewise::scenes {

struct Recipe {
    std::string name;  ///< what the user types; degenerate scenes have none and are opened as files
    std::string file;  ///< below data/, or the file's name in the cache
    std::string what;  ///< one line
    std::uint64_t triangles = 0;            ///< 0: an SDF scene
    int width_px = 1024, height_px = 1024;  ///< the picture it is made for
    bool ships = true;                      ///< a file of data/; else made on demand
    std::function<std::string()> bytes;     ///< empty: a file of data/ that was written by hand
};

/// The named scenes, in the order in which they are listed.
const std::vector<Recipe>& namedRecipes();
/// The SDF scenes likewise.
const std::vector<Recipe>& sdfRecipes();
/// Small scenes that are hard on purpose, for tests: data/degenerate/.
const std::vector<Recipe>& degenerateRecipes();

/// "1": part of the name of the folder in which made scenes are kept.
std::string generatorVersion();

/// The text of data/MANIFEST.md.
std::string manifest();

}  // namespace edgewise::scenes
