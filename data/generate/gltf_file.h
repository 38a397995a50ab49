// A glTF 2.0 file under construction: what the recipes need, no more.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data/generate/portable_math.h"

namespace edgewise::scenes {

using Json = nlohmann::ordered_json;
using Rgba8 = std::array<std::uint8_t, 4>;

/// Goes into every file and into the name of cached ones: raise it with every change of any file's bytes.
inline constexpr int kGeneratorVersion = 1;

/// Vertices and triangles; absent attributes are empty, an empty index means three vertices a triangle.
struct Mesh {
    std::vector<Vec3> position;
    std::vector<Vec3> normal;
    std::vector<Vec2> uv;
    std::vector<Rgba8> color;  ///< COLOR_0, linear, in units of 1/255
    std::vector<std::uint32_t> index;
};

class GltfFile {
  public:
    GltfFile();

    // Each adds one element and returns its index.
    int addImage(const std::string& png);
    int addTexture(int image, Json sampler);
    int addMaterial(Json material);
    int addMesh(Json primitives);
    int addCamera(Json camera);
    int addNode(Json node);  ///< a root of the scene
    int addIndices(const std::vector<std::uint32_t>& index);
    Json addAttributes(const Mesh& mesh);
    Json addPrimitive(const Mesh& mesh, int material);
    void use(const std::string& extension);

    /// One binary file; the same as text with its buffer as a data URI.
    std::string glb() const;
    std::string gltf() const;

  private:
    int add(const char* array, Json element);
    int addView(const std::string& bytes, int target);
    int addAccessor(const std::string& bytes, int target, Json accessor);
    int addFloats(const std::vector<float>& values, int components);

    Json json_;
    std::string binary_;
};

}  // namespace edgewise::scenes
