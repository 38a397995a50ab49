// Animations of a checked glTF: the values of their channels at one time, written into the nodes.
#pragma once

#include <string>

#include "pipeline/gltf_element.h"
#include "pipeline/scene.h"

namespace tinygltf {
class Model;
}

namespace edgewise {

struct GltfCounts;

/// Checks the references of one animation: a part of checkGltf. Its numbers are checked when it is played.
void checkAnimation(const GltfElement& animation, const GltfCounts& counts);

/// Moves the model's nodes to `time` (seconds) of the animation called `wanted` (a name or an index; empty:
/// the first): translation, rotation, scale and morph weights. Before its first key and after its last a
/// channel holds still. STEP, LINEAR (rotations along the shorter arc, slerp) and CUBICSPLINE, as glTF's
/// appendix C defines them. Channels without a node and of an unknown path are skipped, the latter counted as
/// ignored. Throws InputError naming the element: no such animation, keys that do not increase, counts and
/// formats that do not fit, a node with a matrix.
void playAnimation(const GltfElement& root, const std::string& wanted, double time, tinygltf::Model& model,
                   Scene& scene);

}  // namespace edgewise
