// The cameras of a checked glTF.
#pragma once

#include <string>

#include "pipeline/gltf_element.h"
#include "pipeline/gltf_hierarchy.h"
#include "pipeline/scene.h"

namespace edgewise {

/// The camera of nodes[placed.node], if it has one of a known type (others are counted as ignored). Throws
/// InputError if the node's transform leaves it no orientation.
void addCamera(const GltfElement& root, const PlacedNode& placed, Scene& scene);

}  // namespace edgewise
