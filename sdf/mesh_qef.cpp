#include "sdf/mesh_qef.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace edgewise::sdf {
namespace {

constexpr int kSweeps = 12;

/// Jacobi's rotations: afterwards `a` is diagonal, and `vectors`' columns are its eigenvectors.
void diagonalise(glm::dmat3& a, glm::dmat3& vectors) {
    vectors = glm::dmat3(1.0);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(a[p][q]) <= 1e-300 + 1e-17 * (std::abs(a[p][p]) + std::abs(a[q][q]))) continue;
                const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                const double t =
                    (theta < 0.0 ? -1.0 : 1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                const auto rotate = [&](double& x, double& y) {
                    const double keep = x;
                    x = c * keep - s * y, y = s * keep + c * y;
                };
                for (int k = 0; k < 3; ++k) rotate(a[k][p], a[k][q]);
                for (int k = 0; k < 3; ++k) rotate(a[p][k], a[q][k]);
                for (int k = 0; k < 3; ++k) rotate(vectors[p][k], vectors[q][k]);
            }
}

}  // namespace

PlanesPoint nearestToPlanes(std::span<const TangentPlane> planes, const glm::dvec3& about, double cutoff) {
    glm::dmat3 matrix(0.0), vectors;
    glm::dvec3 right(0.0);
    for (const TangentPlane& plane : planes) {
        matrix += glm::outerProduct(plane.normal, plane.normal);
        right += plane.normal * glm::dot(plane.normal, plane.point - about);
    }
    diagonalise(matrix, vectors);
    const double largest = std::max({matrix[0][0], matrix[1][1], matrix[2][2]});
    PlanesPoint result{about, 0, 0.0};
    for (int i = 0; i < 3; ++i) {
        if (!(matrix[i][i] > cutoff * largest)) continue;
        ++result.rank;
        result.place += vectors[i] * (glm::dot(vectors[i], right) / matrix[i][i]);
    }
    for (const TangentPlane& plane : planes)
        result.residual =
            std::max(result.residual, std::abs(glm::dot(plane.normal, result.place - plane.point)));
    return result;
}

}  // namespace edgewise::sdf
