// Node transforms in double, and what survives of them for normals, winding and cameras.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace tinygltf {
class Node;
}

namespace edgewise {

/// The node's matrix, or translation * rotation * scale; the quaternion is normalised first.
glm::dmat4 localTransform(const tinygltf::Node& node);

bool isFinite(const glm::dmat4& matrix);

/// True if the transform mirrors: counter-clockwise triangles become clockwise. A singular one does not.
/// Axes are scaled by powers of two first, so that tiny and huge scales keep their sign.
bool flipsWinding(const glm::dmat4& world_from_node);

/// The inverse transpose of the upper 3x3 up to a positive factor, without dividing by its determinant.
glm::dmat3 normalTransform(const glm::dmat4& world_from_node);

/// The upper 3x3 up to a positive factor that keeps it from overflow: for directions along the surface.
glm::dmat3 tangentTransform(const glm::dmat4& world_from_node);

/// Position and orientation alone: the view axis (column z) keeps its direction, y is made orthogonal to it,
/// x completes a right-handed frame, so scale, mirroring and shear are gone. None if an axis vanishes or y
/// lies along z.
std::optional<glm::dmat4> rigidTransform(const glm::dmat4& world_from_node);

/// v / |v|, without overflow or underflow on the way; none for the zero vector.
std::optional<glm::dvec3> unitVector(const glm::dvec3& v);

}  // namespace edgewise
