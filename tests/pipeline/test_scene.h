// Scenes in memory for the tests of the pipeline.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <initializer_list>

#include "pipeline/project.h"

namespace edgewise::test {

using Corners = std::array<glm::vec3, 3>;

/// Triangles of one node; no vertex is shared between them but by position.
inline Geometry makeGeometry(const std::vector<Corners>& triangles,
                             const glm::dmat4& world = glm::dmat4(1.0)) {
    Geometry geometry;
    for (const Corners& triangle : triangles) {
        const auto first = static_cast<std::uint32_t>(geometry.position_file.size());
        geometry.triangles.push_back({first, first + 1, first + 2});
        for (const glm::vec3& p : triangle) {
            geometry.position_file.push_back(p);
            geometry.position_world.push_back(glm::dvec3(world * glm::dvec4(glm::dvec3(p), 1.0)));
        }
    }
    geometry.world_from_file = world;
    return geometry;
}

/// One node a geometry, one double-sided, unlit, white material.
inline Scene makeScene(std::vector<Geometry> geometry) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = true;
    scene.materials[0].unlit = true;
    for (std::uint32_t i = 0; i < geometry.size(); ++i) {
        geometry[i].node = i;
        geometry[i].first_triangle = static_cast<std::uint32_t>(scene.triangle_count);
        scene.triangle_count += geometry[i].triangles.size();
    }
    scene.geometry = std::move(geometry);
    return scene;
}

/// At the origin, looking down -z; 90 degrees high, so that a pixel of an H-pixel film is 2/H at distance 1.
inline ResolvedCamera makePerspective(double znear = 0.125) {
    ResolvedCamera camera;
    camera.camera.yfov = glm::radians(90.0);
    camera.camera.znear = znear;
    return camera;
}

inline ResolvedCamera makeOrthographic(double ymag) {
    ResolvedCamera camera;
    camera.camera.perspective = false;
    camera.camera.xmag = camera.camera.ymag = ymag;
    camera.camera.znear = 0.0;
    return camera;
}

inline Film makeFilm(int width, int height) {
    Film film;
    film.width = width;
    film.height = height;
    film.crop = {0, 0, width, height};
    return film;
}

}  // namespace edgewise::test
