#include "data/generate/degenerate.h"
#include "data/generate/recipes.h"

namespace edgewise::scenes {
namespace {

using Make = GltfFile (*)();

/// Scenes of a few triangles are text that a person can read; the others are binary.
Recipe recipe(const std::string& stem, int size_px, std::uint64_t triangles, Make make,
              const std::string& what) {
    const bool text = triangles <= 64;
    return {.name = "",
            .file = "degenerate/" + stem + (text ? ".gltf" : ".glb"),
            .what = what,
            .triangles = triangles,
            .width_px = size_px,
            .height_px = size_px,
            .bytes = [=] { return text ? make().gltf() : make().glb(); }};
}

std::vector<Recipe> makeDegenerateRecipes() {
    return {
        recipe("piercing", 64, 3, makePiercing, "three triangles that pierce each other"),
        recipe("piercing-book", 64, 32, makePiercingBook, "sixteen quads through one common line"),
        recipe("cyclic-overlap", 64, 3, makeCyclicOverlap, "three triangles, each over the next"),
        recipe("t-junctions", 64, 24, makeTJunctions, "rows against one long edge, straight and slanted"),
        recipe("coplanar-duplicates", 64, 5, makeCoplanarDuplicates,
               "one plane covered twice with other diagonals"),
        recipe("equal-depth", 64, 6, makeEqualDepth, "boxes of three nodes at one depth"),
        recipe("slivers", 64, 20, makeSlivers, "triangles from 1 px to 1e-5 px wide"),
        recipe("fan-1000", 32, 1000, makeFan1000, "a thousand triangles around a vertex on a pixel's centre"),
        recipe("near-plane", 64, 10, makeNearPlane, "cut by the near and far planes, behind the eye"),
        recipe("zero-area", 32, 10, makeZeroArea, "points, lines and edge-on triangles"),
        recipe("decals", 64, 7, makeDecals, "coplanar decals before their base, in perspective"),
        recipe("closed-sphere", 64, 512, makeClosedSphere, "a closed sphere, back faces culled"),
        recipe("two-spheres", 64, 1024, makeTwoSpheres, "two closed spheres that pierce each other"),
        recipe("pixel-edges", 32, 17, makePixelEdges, "edges on pixel borders and through samples"),
        recipe("thin-wires", 128, 60, makeThinWires, "wires from 2 px down to 0.012 px wide"),
    };
}

}  // namespace

const std::vector<Recipe>& degenerateRecipes() {
    static const std::vector<Recipe> recipes = makeDegenerateRecipes();
    return recipes;
}

}  // namespace edgewise::scenes
