// The point nearest to several planes: where a sharp edge or corner is.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace edgewise::sdf {

struct TangentPlane {
    glm::dvec3 point, normal;  ///< unit normal
};

struct PlanesPoint {
    glm::dvec3 place;
    int rank;         ///< 1: a smooth part, 2: on a sharp edge, 3: a corner
    double residual;  ///< largest distance to one of the planes
};

/// Least squares, the quadratic error function of Ju et al. 2002, by its eigenvalues: directions whose
/// eigenvalue is at most `cutoff` of the largest one stay where `about` is.
PlanesPoint nearestToPlanes(std::span<const TangentPlane> planes, const glm::dvec3& about, double cutoff);

}  // namespace edgewise::sdf
