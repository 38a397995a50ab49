#include "data/generate/recipes.h"
#include "data/generate/sdf_scenes.h"

namespace edgewise::scenes {
namespace {

/// 1280 x 720, as in the papers on sphere tracing.
Recipe sdf(const std::string& name, const std::string& what, std::function<std::string()> bytes = {},
           bool ships = true) {
    return {.name = name,
            .file = name + ".sdf.json",
            .what = what,
            .width_px = 1280,
            .height_px = 720,
            .ships = ships,
            .bytes = std::move(bytes)};
}

std::vector<Recipe> makeSdfRecipes() {
    return {
        sdf("primitives", "one of every shape, on the ground"),
        sdf("random-box", "many random boxes, at the cost of the CTSS paper's scene",
            [] { return makeRandomBoxes(128); }),
        sdf("random-shape", "many random shapes, likewise", [] { return makeRandomShapes(96); }),
        sdf("sparse-shape", "few shapes, far apart, likewise", makeSparseShapes),
        sdf("atrium", "arcades, galleries, a floor and curtains: an interior at the cost of a Sponza SDF"),
        sdf("jewel", "a brilliant cut, reflective and refractive: Keinert et al., Figure 1"),
        sdf("city", "blocks of buildings to the horizon: Keinert et al., Figure 1"),
        sdf("path-room", "a room of analytic walls, a mirror, a lamp and an SDF: Keinert et al., Figure 1"),
        sdf("convex", "a glass dodecahedron among analytic spheres: Keinert et al., Figure 11"),
        sdf("thin", "thin silhouettes over a floor: Keinert et al., Figure 8"),
        sdf("blob", "a displaced, textured blob: Keinert et al., Figures 9 and 10"),
        sdf("gyroid", "a gyroid's sheet within a ball"),
        sdf("menger-3", "three levels of Menger's sponge"),
        sdf("sphere-minus-box", "a ball without a turned box"),
        sdf("spheres-50", "50 spheres, united smoothly", [] { return makeSmoothSpheres(50); }),
        sdf(
            "spheres-1000", "1000 spheres, united smoothly", [] { return makeSmoothSpheres(1000); }, false),
        sdf("wires", "wires from 0.05 to 1 px wide", makeWires),
        sdf("slabs", "three overlapping slabs of glass"),
    };
}

}  // namespace

const std::vector<Recipe>& sdfRecipes() {
    static const std::vector<Recipe> recipes = makeSdfRecipes();
    return recipes;
}

}  // namespace edgewise::scenes
