// The tree of a document.
#pragma once

#include "sdf/field_scene.h"
#include "sdf/parse_json.h"

namespace edgewise::sdf {

/// Nodes within each other, and in all; more is refused.
inline constexpr int kMostTreeLevels = 256;
inline constexpr std::size_t kMostNodes = 100000;

/// What any node may have beside its own numbers: "scale", "rotate" and "at" become nodes around it, in this
/// order from within; "material" and "lipschitz" are the node's own.
struct CommonKeys {
    NumberInfo lipschitz{"lipschitz", false, Rule::kPositive};
    NumberInfo scale{"scale", false, Rule::kPositive};
    NumberInfo at{"at", true};
    NumberInfo axis{"axis", true, Rule::kNotZero};
    NumberInfo degrees{"degrees"};
};
const CommonKeys& commonKeys();

/// Throws SceneError. Twists without a radius get that of their child's box.
Tree readTree(const Json& node, const std::vector<SurfaceMaterial>& materials);

}  // namespace edgewise::sdf
