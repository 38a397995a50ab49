#include "pipeline/gltf_place.h"

#include <cmath>
#include <utility>

#include "pipeline/error.h"
#include "pipeline/gltf_primitive.h"
#include "pipeline/gltf_transform.h"

namespace edgewise {
namespace {

/// What one affine map does to directions.
struct DirectionMap {
    glm::dmat3 normals, tangents;
    double sign;  ///< of the bitangent, cross(normal, tangent) * sign: -1 under a mirror

    explicit DirectionMap(const glm::dmat4& m)
        : normals(normalTransform(m)), tangents(tangentTransform(m)), sign(flipsWinding(m) ? -1.0 : 1.0) {}
};

glm::dvec4 moved(const DirectionMap& map, const glm::dvec4& tangent) {
    return {map.tangents * glm::dvec3(tangent), (tangent.w < 0.0 ? -1.0 : 1.0) * map.sign};
}

}  // namespace

void placeRigidly(Geometry& geometry, const glm::dmat4& world_from_node, const std::string& where) {
    for (glm::dvec3& position : geometry.position_world) {
        position = glm::dvec3(world_from_node * glm::dvec4(position, 1.0));
        if (!(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)))
            throw InputError(where, "a vertex is not finite in world space");
    }
    if (geometry.world_from_file) geometry.world_from_file = world_from_node;
    const DirectionMap map(world_from_node);
    for (glm::dvec3& normal : geometry.normal_world) normal = map.normals * normal;
    for (glm::dvec4& tangent : geometry.tangent_world) tangent = moved(map, tangent);
    if (map.sign < 0.0)
        for (auto& triangle : geometry.triangles) std::swap(triangle[1], triangle[2]);
}

void placeSkinned(Geometry& geometry, const std::vector<glm::dmat4>& world_from_vertex,
                  const std::string& where) {
    std::vector<bool> mirrored(world_from_vertex.size());
    for (std::size_t v = 0; v < world_from_vertex.size(); ++v) {
        const DirectionMap map(world_from_vertex[v]);
        mirrored[v] = map.sign < 0.0;
        geometry.position_world[v] =
            glm::dvec3(world_from_vertex[v] * glm::dvec4(geometry.position_world[v], 1.0));
        if (!geometry.normal_world.empty()) geometry.normal_world[v] = map.normals * geometry.normal_world[v];
        if (!geometry.tangent_world.empty())
            geometry.tangent_world[v] = moved(map, geometry.tangent_world[v]);
    }
    adoptPositions(geometry, where);
    for (auto& triangle : geometry.triangles)
        if (mirrored[triangle[0]]) std::swap(triangle[1], triangle[2]);
}

}  // namespace edgewise
