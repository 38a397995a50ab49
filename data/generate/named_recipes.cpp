#include "data/generate/flat_patterns.h"
#include "data/generate/random_triangles.h"
#include "data/generate/recipes.h"
#include "data/generate/tori.h"

namespace edgewise::scenes {
namespace {

Recipe torus(const std::string& size, std::uint32_t around, std::uint32_t tube, bool ships) {
    const std::string name = "torus-" + size;
    return {.name = name,
            .file = name + ".glb",
            .what = "one closed, lit torus with smooth normals",
            .triangles = std::uint64_t{2} * around * tube,
            .ships = ships,
            .bytes = [=] { return makeTorus(around, tube).glb(); }};
}

Recipe randomTriangles(const std::string& size, std::uint32_t count, bool ships) {
    const std::string name = "random-" + size;
    return {.name = name,
            .file = name + ".glb",
            .what = "random triangles that overlap and pierce each other, four deep on average",
            .triangles = count,
            .ships = ships,
            .bytes = [=] { return makeRandomTriangles(count).glb(); }};
}

std::vector<Recipe> makeNamedRecipes() {
    return {
        {.name = "zone-plate",
         .file = "zone-plate.glb",
         .what = "the NSAA paper's Figure 4: 125 concentric rings of equal area",
         .triangles = 20000,
         .bytes = [] { return makeZonePlate().glb(); }},
        {.name = "log-grid",
         .file = "log-grid.glb",
         .what = "the NSAA paper's Figure 5: a checkerboard between lines at binary logarithms",
         .triangles = 20200,
         .bytes = [] { return makeLogGrid().glb(); }},
        {.name = "torus-sequence",
         .file = "torus-sequence.glb",
         .what = "the NSAA paper's Figure 7: seven checkered tori, receding and turning",
         .triangles = 7 * 2 * 96 * 48,
         .height_px = 512,
         .bytes = [] { return makeTorusSequence().glb(); }},
        torus("20k", 200, 50, true),
        torus("200k", 500, 200, false),
        torus("1m", 1000, 500, false),
        randomTriangles("2k", 2000, true),
        randomTriangles("20k", 20000, true),
        randomTriangles("200k", 200000, false),
    };
}

}  // namespace

const std::vector<Recipe>& namedRecipes() {
    static const std::vector<Recipe> recipes = makeNamedRecipes();
    return recipes;
}

}  // namespace edgewise::scenes
