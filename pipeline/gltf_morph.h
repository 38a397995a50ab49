// Morph targets: displacements of positions, normals and tangents, weighted and added.
#pragma once

#include "pipeline/gltf_attribute.h"
#include "pipeline/gltf_primitive.h"

namespace edgewise {

/// Adds weight * displacement for every target whose weight is not 0; others are not even read. Normals and
/// tangents are displaced where the base has them. True if positions changed.
bool addMorphTargets(const tinygltf::Primitive& primitive, const AttributeReader& reader,
                     const std::vector<double>& weights, Geometry& geometry);

}  // namespace edgewise
