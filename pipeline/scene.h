// A scene as plain data: what load_gltf makes and every later stage reads. World space, right-handed, +y up.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace edgewise {

namespace sdf {
struct FieldScene;
}

class PointShader;

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// 8-bit or float texels decoded to linear RGBA doubles on access; row 0 is the top row.
struct Image {
    int width = 0, height = 0;
    std::vector<glm::vec4> texels;  ///< linear Rec.709, straight alpha
    std::string name;
};

enum class Wrap { kRepeat, kMirroredRepeat, kClampToEdge };
enum class TexelFilter { kNearest, kLinear };

struct Texture {
    std::uint32_t image = kNone;
    Wrap wrap_s = Wrap::kRepeat, wrap_t = Wrap::kRepeat;
    TexelFilter mag = TexelFilter::kLinear, min = TexelFilter::kLinear;
    std::optional<TexelFilter> mip = TexelFilter::kLinear;  ///< none: level 0 only
};

/// A texture as one slot of a material uses it.
struct TextureUse {
    std::uint32_t texture = kNone;  ///< into Scene::textures
    int uv = 0;                     ///< TEXCOORD_0 or _1
    /// The texture's (u, v, 1) from the vertex's: KHR_texture_transform, identity without it.
    glm::dmat3 uv_from_vertex{1.0};

    bool present() const { return texture != kNone; }
};

enum class AlphaMode { kOpaque, kMask, kBlend };

/// glTF 2.0's metallic-roughness material; factors and colours are linear.
struct Material {
    std::string name;
    glm::dvec4 base_color{1.0};
    TextureUse base_color_map;  ///< sRGB colours, linear alpha
    double metallic = 1.0, roughness = 1.0;
    TextureUse metallic_roughness_map;  ///< green: roughness, blue: metallic
    TextureUse normal_map;
    double normal_scale = 1.0;
    TextureUse occlusion_map;  ///< red: how much of the ambient light arrives
    double occlusion_strength = 1.0;
    glm::dvec3 emissive{0.0};  ///< times KHR_materials_emissive_strength
    TextureUse emissive_map;   ///< sRGB
    AlphaMode alpha_mode = AlphaMode::kOpaque;
    double alpha_cutoff = 0.5;  ///< mask: seen where alpha is this or more
    bool unlit = false;
    bool double_sided = false;
};

/// Vertex attributes of one primitive of one node, already in world space. Absent attributes are empty.
struct Geometry {
    /// As stored in the file, before the node's transform and before a normalized integer's division: exact.
    /// Moved by morph targets or a skin: the mesh's (a skin's: the world's) positions, rounded to float32
    /// once; the world's positions follow from the rounded ones.
    std::vector<glm::vec3> position_file;
    std::vector<glm::dvec3> position_world;
    std::vector<glm::dvec3> normal_world;  ///< not normalised; empty: flat normals
    /// TANGENT: direction in world space, not normalised, and the bitangent's sign.
    std::vector<glm::dvec4> tangent_world;
    /// The affine map from position_file to position_world, if there is one (no normalized integers): depth
    /// planes are taken through it from the exact planes. None: through the rounded world positions.
    std::optional<glm::dmat4> world_from_file;
    std::array<std::vector<glm::dvec2>, 2> uv;
    std::vector<glm::dvec4> color;                        ///< COLOR_0, linear
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< winding already flipped under negative scale
    std::uint32_t material = 0;                           ///< into Scene::materials
    std::uint32_t node = 0, mesh = 0, primitive = 0;      ///< the file's indices
    std::uint32_t instance = 0;                           ///< of the node's EXT_mesh_gpu_instancing
    std::uint32_t first_triangle = 0;                     ///< contract index of triangles[0]
};

struct Camera {
    std::string name;
    std::uint32_t node = kNone;
    glm::dmat4 world_from_camera{1.0};  ///< rigid: looks down -z, +y up
    bool perspective = true;
    double yfov = 0.0;              ///< radians; perspective
    double xmag = 0.0, ymag = 0.0;  ///< half extents; orthographic
    std::optional<double> aspect;
    double znear = 0.0;
    std::optional<double> zfar;  ///< none: infinite
};

/// KHR_lights_punctual. Lights shine along -z of their node; its scale does not count.
struct Light {
    enum class Type { kDirectional, kPoint, kSpot };
    std::string name;
    std::uint32_t node = kNone;
    Type type = Type::kPoint;
    glm::dvec3 color{1.0};                         ///< linear
    double intensity = 1.0;                        ///< candela; directional: lux
    std::optional<double> range;                   ///< beyond it no light arrives
    double inner_cone_angle = 0.0;                 ///< radians; spot
    double outer_cone_angle = 0.7853981633974483;  ///< radians; spot
    glm::dvec3 position_world{0.0};
    glm::dvec3 direction_world{0.0, 0.0, -1.0};  ///< unit, the way the light travels
};

/// One warning the user sees once: what the file uses and edgewise ignores.
struct Ignored {
    std::string what;
    std::size_t count = 0;
};

struct Scene {
    std::string source;               ///< file or name, as the user gave it
    std::vector<Geometry> geometry;   ///< in index order: depth-first nodes, their mesh's primitives
    std::vector<Material> materials;  ///< the file's, in order, then the default one
    std::vector<Texture> textures;    ///< those that drawn materials use; never without an image
    std::vector<Image> images;
    std::vector<Camera> cameras;  ///< camera nodes in depth-first order
    std::vector<Light> lights;    ///< in depth-first order of their nodes; none: the default rig
    std::vector<std::string> node_names, mesh_names;
    std::vector<Ignored> ignored;
    std::size_t triangle_count = 0;
    glm::dvec3 bounds_min{0.0}, bounds_max{0.0};
    std::shared_ptr<const sdf::FieldScene>
        field;  ///< an SDF scene; cameras, lights and bounds above are its own
    /// Triangles are shaded by it and not by their materials: a mesh of an SDF scene.
    std::shared_ptr<const PointShader> point_shader;
};

/// Where triangle `index` of the scene lives.
struct TriangleRef {
    std::uint32_t geometry;
    std::uint32_t triangle;
};

/// The triangle behind a contract index below Scene::triangle_count.
inline TriangleRef findTriangle(const Scene& scene, std::uint32_t index) {
    const auto after =
        std::upper_bound(scene.geometry.begin(), scene.geometry.end(), index,
                         [](std::uint32_t i, const Geometry& g) { return i < g.first_triangle; });
    const auto geometry = static_cast<std::uint32_t>(after - scene.geometry.begin() - 1);
    return {geometry, index - scene.geometry[geometry].first_triangle};
}

}  // namespace edgewise
