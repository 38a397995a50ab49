// Where the vertex of a part of the surface belongs: on its sharp edge or corner, else on its middle.
#pragma once

#include <span>

#include "sdf/mesh_qef.h"
#include "sdf/tape_at.h"

namespace edgewise::sdf {

struct FeaturePoint {
    glm::dvec3 place_world;
    int rank;  ///< as PlanesPoint's
};

/// The point moved along gradients to where the value is 0.
glm::dvec3 onSurface(const TapeAt& tape, const glm::dvec3& from_world);

/// `planes`: tangent planes where the surface crosses the cell's edges. A sharp edge or corner is where
/// planes taken ever nearer to it still differ: elsewhere their point is asked for again among planes a tenth
/// as far away, so that curved surfaces' edges are found too and round ones are not taken for sharp.
/// Within `step` (a cell's side) times 2 of `about`, towards which it is free to go along a sharp edge. At
/// most kMostPlanes.
FeaturePoint featurePoint(const TapeAt& tape, std::span<const TangentPlane> planes, const glm::dvec3& about,
                          double step);
inline constexpr int kMostPlanes = 64;

}  // namespace edgewise::sdf
