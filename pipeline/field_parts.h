// An SDF scene in parts that triangles can stand for: what is bounded, and half-spaces united with it.
#pragma once

#include <vector>

#include "sdf/field_scene.h"

namespace edgewise {

/// dot(p, normal) <= offset.
struct HalfSpace {
    glm::dvec3 normal_world{0.0, 1.0, 0.0};  ///< unit
    double offset = 0.0;
};

struct FieldParts {
    sdf::FieldScene rest;  ///< all but the half-spaces; an empty tree: there is nothing else
    std::vector<HalfSpace> half_spaces;
};

/// Half-spaces are found under plain unions and moves from the root on. The union's surface is what is seen
/// of its parts' from outside.
FieldParts partsOf(const sdf::FieldScene& field);

}  // namespace edgewise
