// One primitive of a checked glTF mesh: triangles and vertex attributes, in the mesh's own space.
#pragma once

#include <string>
#include <vector>

#include "pipeline/gltf_skin.h"
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
    std::vector<double> morph_weights;  ///< of targets[i]; missing ones are 0
};

/// True if the primitive makes triangles at all (mode, positions); others are ignored.
bool drawsTriangles(const tinygltf::Primitive& primitive);

struct PrimitiveSize {
    std::size_t vertices = 0, triangles = 0;
    bool has_bytes = true;      ///< false: positions without a buffer view, zeros but for a sparse part
    std::size_t left_over = 0;  ///< indices or vertices at the end that make no whole triangle
};
PrimitiveSize primitiveSize(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

struct LocalPrimitive {
    Geometry geometry;  ///< its "world" is the mesh's space; the node's transform or its skin follow
    SkinInfluences influences;
};

/// Reads attributes and triangles, and adds the morph targets. Strips and fans become triangles in the
/// specification's vertex order. Throws InputError naming the primitive or the accessor: a format the
/// attribute may not have, differing counts, an index out of range.
LocalPrimitive readPrimitive(const PrimitiveContext& context);

/// Positions that no longer are the file's: rounded to float32, once, and those rounded ones are the scene
/// from here on, so that exact arithmetic goes on as for a file that had them. Throws InputError "WHERE: ..."
/// if one is beyond float32.
void adoptPositions(Geometry& geometry, const std::string& where);

}  // namespace edgewise
