#include "sdf/load_sdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sdf/json_reader.h"
#include "sdf/load_tree.h"
#include "sdf/load_views.h"

namespace edgewise::sdf {
namespace {

void requireTraceable(const FieldScene& scene) {
    for (const Instruction& i : lower(scene.tree).instructions)
        if (!(i.lipschitz <= kSteepest && i.lipschitz >= 1.0 / kSteepest))
            refuse(scene.tree.nodes[i.node].path,
                   fmt::format("changes {} as fast as position does, which must be from {} to {}",
                               i.lipschitz, 1.0 / kSteepest, kSteepest));
}

}  // namespace

FieldScene loadSdf(std::string_view text) {
    if (text.size() > kMostSceneBytes)
        refuse("the file", fmt::format("must have at most {} bytes, not {}", kMostSceneBytes, text.size()));
    const Json document = parseJson(text);
    requireObject(document, "the file");
    FieldScene scene;
    scene.materials = readMaterials(document);
    readViews(document, scene);
    if (!document.contains("tree")) refuse("tree", "must be given");
    scene.tree = readTree(document["tree"], scene.materials);
    requireTraceable(scene);
    scene.bounds = sceneBounds(scene);
    if (!document.contains("far")) scene.far = std::max(scene.far, farFor(scene.bounds));
    return scene;
}

}  // namespace edgewise::sdf
