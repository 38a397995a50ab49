// A field's mesh as a scene of triangles.
#pragma once

#include <span>

#include "pipeline/field_parts.h"
#include "pipeline/mesh_store.h"

namespace edgewise {

/// The mesh, and half-spaces as discs that end where rays do, with the cameras and lights of the input's
/// scene; points of it are shaded by the field, which has no closed forms beside its tree.
Scene meshScene(const MethodInput& input, const sdf::FieldScene& field, const FilmPolygons& polygons,
                std::span<const HalfSpace> half_spaces);

}  // namespace edgewise
