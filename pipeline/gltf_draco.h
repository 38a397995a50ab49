// KHR_draco_mesh_compression: primitives whose indices and attributes are one compressed piece.
#pragma once

#include "pipeline/gltf_element.h"
#include "pipeline/scene.h"

namespace tinygltf {
class Model;
}

namespace edgewise {

struct GltfCounts;

/// Checks the references of a primitive's extension, if it has it: a part of checkGltf.
void checkDraco(const GltfElement& primitive, const GltfCounts& counts);

/// Decodes every compressed primitive into accessors and buffers of its own, which take the place of those it
/// names. Throws InputError naming the primitive: bytes that cannot be decoded, attributes that are not
/// there, and counts or components that differ from its accessors'.
void unpackDraco(const GltfElement& root, tinygltf::Model& model);

}  // namespace edgewise
