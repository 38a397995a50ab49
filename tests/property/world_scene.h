// A scene as float32 triangles in front of an orthographic camera that puts one unit on one pixel: positions
// in multiples of 2^-32 are on the screen's grid as they are, so that what fails on the screen is a glTF
// file.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "pipeline/film.h"

namespace edgewise::property {

/// The film's side in pixels; the world's origin is its middle, a corner of four pixels and of four cells.
inline constexpr int kFilmPx = 32;

/// How the scene is seen. Perspective: by an eye amid its depths, so that triangles pass the near plane and
/// the eye.
enum class Lens { kOrthographic, kPerspective };

struct WorldTriangle {
    std::array<glm::vec3, 3> p_world;  ///< z in [-1024, 0], 0 the nearest
    int node = 0;                      ///< triangles of one node share the planes they have in common
};

/// By ascending node, so that a triangle's place here is its index in the file.
struct WorldScene {
    std::vector<WorldTriangle> triangles;
    Lens lens = Lens::kOrthographic;
};

/// A file of its own: data URI, camera, double-sided unlit materials, a colour a triangle.
std::string gltfOf(const WorldScene& scene);

/// What gltfOf() wrote, read back.
WorldScene readWorld(const std::filesystem::path& gltf);

/// The scene as load_gltf gives it, and its film.
struct View {
    Scene scene;
    ResolvedCamera camera;
    Film film;
};

View viewOf(const std::filesystem::path& gltf, const PixelBox& crop);
/// Through a file in a temporary folder.
View viewOf(const WorldScene& scene, const PixelBox& crop);

}  // namespace edgewise::property
