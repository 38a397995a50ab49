// Closed forms as parts of the field, for what looks at distances and not at hits.
#pragma once

#include "sdf/field_scene.h"

namespace edgewise::sdf {

/// The scene with its analytic shapes as children of one union with the tree, and without the convex
/// shortcut. Planes, which are seen from both sides, become the half-spaces that `eye_world` is not in.
FieldScene fieldOfAll(FieldScene scene, const glm::dvec3& eye_world);

}  // namespace edgewise::sdf
