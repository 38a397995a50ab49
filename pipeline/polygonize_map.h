// Meshes of raw GLSL maps: a device answers for the field.
#pragma once

#include <optional>

#include "pipeline/polygonize.h"
#include "sdf/field_scene.h"

namespace edgewise {

/// As polygonize(), which sends raw GLSL here. Without a box the map's own bounds are looked for as far as
/// its `far` from the origin. Throws InputError too for a mesher that cannot have it, DeviceError without a
/// Vulkan device.
Polygonized polygonizeMap(const Scene& scene, const PolygonizeOptions& options);

/// A box around a map's solid; none where it is unbounded, empty or breaks its bound, or without a device.
/// Throws InputError for GLSL that does not compile.
std::optional<sdf::Box> boundsOfMap(const sdf::FieldScene& map);

}  // namespace edgewise
