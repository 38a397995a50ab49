// Meshes of raw GLSL maps: a device answers for the field.
#pragma once

#include "pipeline/polygonize.h"

namespace edgewise {

/// As polygonize(), which sends raw GLSL here. Without a box the map's own bounds are looked for as far as
/// its `far` from the origin. Throws InputError too for a mesher that cannot have it, DeviceError without a
/// Vulkan device.
Polygonized polygonizeMap(const Scene& scene, const PolygonizeOptions& options);

}  // namespace edgewise
