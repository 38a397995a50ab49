// KHR_lights_punctual: what it lists, and where its nodes put it.
#pragma once

#include "pipeline/gltf_element.h"
#include "pipeline/gltf_hierarchy.h"
#include "pipeline/scene.h"

namespace edgewise {

/// Checks the file's list of lights and the nodes' references into it: a part of checkGltf.
void checkLights(const GltfElement& root);

/// The light of nodes[placed.node], if it has one of a known type (others are counted as ignored): at the
/// node's origin, along its -z axis. Throws InputError if a light that has a direction gets none, since that
/// axis vanishes in the world.
void addLight(const GltfElement& root, const PlacedNode& placed, Scene& scene);

}  // namespace edgewise
