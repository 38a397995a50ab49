// What several recipes share: materials, cameras, heaps of coloured triangles.
#pragma once

#include "data/generate/gltf_file.h"

namespace edgewise::scenes {

int addUnlitMaterial(GltfFile& file, const std::string& name, std::array<double, 3> color, bool double_sided);

/// A camera that maps [0, size_px]^2 of the plane z = anything to a square picture, one world unit a pixel
/// at that size; it looks down -z from z = 4096 and sees -4095 < z < 4095. World y points up.
void addPixelCamera(GltfFile& file, double size_px);

struct Lens {
    double yfov = 0.0;  ///< radians
    double aspect = 1.0;
    double znear = 0.01, zfar = 100.0;
};
/// `pose`: the camera node's translation, rotation.
void addPerspectiveCamera(GltfFile& file, const Lens& lens, Json pose);

/// A glTF quaternion: `turns` about the unit vector `axis`.
Json rotation(Vec3 axis, double turns);

/// Triangles that share no vertex, each with a colour of its own.
class Soup {
  public:
    /// `first`: where this heap's run of colours starts, so that two heaps of one scene differ.
    explicit Soup(std::uint32_t first = 0) : next_color_(first) {}

    void triangle(Vec3 a, Vec3 b, Vec3 c);
    void triangle(Vec3 a, Vec3 b, Vec3 c, Rgba8 color);
    /// Corners in order around it: (a, b, c) and (a, c, d).
    void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
    const Mesh& mesh() const { return mesh_; }

  private:
    Mesh mesh_;
    std::uint32_t next_color_;
};

/// Bright, saturated and different for every i a small scene uses: no component below 32/255.
Rgba8 paletteColor(std::uint32_t i);

/// A mesh, a node, and in an unlit double-sided material unless `material` names another.
void addSoup(GltfFile& file, const Soup& soup, Json node = Json::object());
void addSoup(GltfFile& file, const Soup& soup, int material, Json node = Json::object());

}  // namespace edgewise::scenes
