// One primitive of a checked glTF mesh: triangles and vertex attributes, in the node's own space.
#pragma once

#include <string>
#include <utility>

#include "pipeline/scene.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace edgewise {

struct PrimitiveContext {
    const tinygltf::Model& model;
    const std::string& source;
    bool quantized = false;  ///< KHR_mesh_quantization is in use: more vertex formats are legal
    int mesh = 0, primitive = 0;
};

/// True if the primitive makes triangles at all (mode, positions); others are ignored.
bool drawsTriangles(const tinygltf::Primitive& primitive);

struct PrimitiveSize {
    std::size_t vertices = 0, triangles = 0;
    std::size_t left_over = 0;  ///< indices or vertices at the end that make no whole triangle
};
PrimitiveSize primitiveSize(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

/// Reads attributes and triangles; positions and normals are local (position_world holds the node's space).
/// Strips and fans become triangles in the specification's vertex order. Throws InputError naming the
/// primitive or the accessor: a format the attribute may not have, differing counts, an index out of range.
Geometry readPrimitive(const PrimitiveContext& context);

}  // namespace edgewise
