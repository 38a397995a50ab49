// Geometries of scenes that no file holds: meshes of SDF scenes.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "pipeline/scene.h"

namespace edgewise {

/// Where the first triangles of a geometry come from; vertices with several normals are several.
class GeometryBuilder {
  public:
    void add(std::uint32_t vertex, const glm::dvec3& p_world, const glm::dvec3& normal_world) {
        const auto [found, is_new] =
            vertices_.try_emplace({vertex, {normal_world.x, normal_world.y, normal_world.z}},
                                  static_cast<std::uint32_t>(made.position_file.size()));
        corners_.push_back(found->second);
        if (is_new) {
            made.position_file.emplace_back(p_world);
            // What a file would hold: the scene is the same as the mesh that polygonize writes.
            made.position_world.emplace_back(made.position_file.back());
            made.normal_world.push_back(normal_world);
        }
        if (corners_.size() < 3) return;
        made.triangles.push_back({corners_[0], corners_[1], corners_[2]});
        corners_.clear();
    }

    Geometry made;

  private:
    std::map<std::pair<std::uint32_t, std::array<double, 3>>, std::uint32_t> vertices_;
    std::vector<std::uint32_t> corners_;
};

/// As a node and a mesh of that name.
inline void addGeometry(Scene& scene, Geometry geometry, std::uint32_t material, const char* name) {
    if (geometry.triangles.empty()) return;
    geometry.material = material;
    geometry.world_from_file = glm::dmat4(1.0);
    geometry.node = geometry.mesh = static_cast<std::uint32_t>(scene.node_names.size());
    geometry.first_triangle = static_cast<std::uint32_t>(scene.triangle_count);
    scene.triangle_count += geometry.triangles.size();
    scene.node_names.emplace_back(name), scene.mesh_names.emplace_back(name);
    scene.geometry.push_back(std::move(geometry));
}

}  // namespace edgewise
