#include "sdf/mesh_attributes.h"

#include <glm/geometric.hpp>

#include "sdf/evaluate.h"
#include "sdf/unit_or.h"

namespace edgewise::sdf {
namespace {

/// How far from a corner to the centre its normal is asked for.
constexpr double kInward = 0.02;

glm::dvec3 centreOf(const SurfaceMesh& mesh, const Triangle& t) {
    return (mesh.position_world[t[0]] + mesh.position_world[t[1]] + mesh.position_world[t[2]]) / 3.0;
}

}  // namespace

void findMaterials(const TapeAt& tape, SurfaceMesh& mesh) {
    mesh.material.resize(mesh.triangles.size());
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const glm::dvec3 centre = centreOf(mesh, mesh.triangles[n]);
        glm::dvec3 local;
        mesh.material[n] = winnerAt(tape(centre), centre, local).material;
    }
}

void findNormals(const TapeAt& tape, SurfaceMesh& mesh) {
    mesh.normal_world.resize(mesh.triangles.size());
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const Triangle& t = mesh.triangles[n];
        glm::dvec3 corner[3];
        for (int i = 0; i < 3; ++i) corner[i] = mesh.position_world[t[i]];
        const glm::dvec3 centre = centreOf(mesh, t);
        const glm::dvec3 flat = unitOr(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), {0, 1, 0});
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 p = corner[i] + kInward * (centre - corner[i]);
            const glm::dvec3 normal = unitOr(gradientAt(tape(p), p).gradient, flat);
            mesh.normal_world[n][i] = glm::dot(normal, flat) > 0.0 ? normal : flat;
        }
    }
}

}  // namespace edgewise::sdf
