// The mesh of a raw GLSL map as a scene of triangles.
#pragma once

#include "pipeline/mesh_store.h"

namespace edgewise {

/// With the cameras and lights of the input's scene. Points are shaded as tracing shades them, in the mesh's
/// colours and with its normals, but that nothing stands before a light: a map answers on a device, many
/// points at once, and not point by point.
Scene mapMeshScene(const MethodInput& input, const FilmPolygons& polygons);

/// Whether it is seen that lights throw no shadows there.
bool losesShadows(const sdf::FieldScene& map);

}  // namespace edgewise
