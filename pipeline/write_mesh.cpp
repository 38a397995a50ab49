#include "pipeline/write_mesh.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "pipeline/atomic_file.h"
#include "pipeline/version.h"
#include "sdf/field_scene.h"

#include <tiny_gltf.h>

namespace edgewise {
namespace {

namespace gltf = tinygltf;

std::vector<double> list(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// The nearest that glTF's metallic-roughness has.
gltf::Material materialOf(const sdf::SurfaceMaterial& from) {
    gltf::Material material;
    material.name = from.name;
    material.pbrMetallicRoughness.baseColorFactor = {from.color.x, from.color.y, from.color.z, 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    const bool shines = from.shading == sdf::SurfaceMaterial::Shading::kBlinnPhong;
    // Blinn-Phong's exponent by the usual correspondence: 2 / alpha^2 - 2, alpha = roughness^2.
    material.pbrMetallicRoughness.roughnessFactor =
        shines ? std::sqrt(std::sqrt(2.0 / (from.shininess + 2.0))) : 1.0;
    material.emissiveFactor = list(glm::min(from.emission, glm::dvec3(1.0)));
    if (from.shading == sdf::SurfaceMaterial::Shading::kUnlit)
        material.extensions["KHR_materials_unlit"] = gltf::Value(gltf::Value::Object{});
    return material;
}

/// One material's triangles.
struct Primitive {
    using Look = std::array<float, 6>;  ///< a normal and a colour
    std::vector<float> positions, normals, colors;
    std::vector<std::uint32_t> indices;
    std::map<std::pair<std::uint32_t, Look>, std::uint32_t> vertices;

    void add(std::uint32_t vertex, const glm::dvec3& position, const glm::dvec3& normal,
             const std::optional<glm::dvec3>& color) {
        const glm::vec3 n(normal), c(glm::clamp(color.value_or(glm::dvec3(0.0)), 0.0, 1.0));
        const auto [found, is_new] = vertices.try_emplace({vertex, Look{n.x, n.y, n.z, c.x, c.y, c.z}},
                                                          static_cast<std::uint32_t>(positions.size() / 3));
        indices.push_back(found->second);
        if (!is_new) return;
        for (int i = 0; i < 3; ++i) {
            positions.push_back(static_cast<float>(position[i])), normals.push_back(n[i]);
            if (color) colors.push_back(c[i]);
        }
    }
};

class Writer {
  public:
    Writer(const sdf::SurfaceMesh& mesh, const Scene& scene) : mesh_(mesh), scene_(scene) {}

    std::string run(const std::string& command) {
        model_.asset.version = "2.0";
        model_.asset.generator = "edgewise " + std::string(version());
        model_.asset.extras = gltf::Value(gltf::Value::Object{{"command", gltf::Value(command)}});
        model_.buffers.resize(1);
        model_.scenes.resize(1);
        model_.defaultScene = 0;
        addMesh(), addCameras(), addLights();
        std::ostringstream out;
        gltf::TinyGLTF().WriteGltfSceneToStream(&model_, out, false, true);
        return out.str();
    }

  private:
    void addNode(gltf::Node node) {
        model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
        model_.nodes.push_back(std::move(node));
    }

    void addMesh() {
        const auto& materials = scene_.field->materials;
        for (const sdf::SurfaceMaterial& material : materials)
            model_.materials.push_back(materialOf(material));
        // Colours of vertices are all there is.
        if (!mesh_.color.empty())
            model_.materials[0].pbrMetallicRoughness.baseColorFactor = {1.0, 1.0, 1.0, 1.0};
        for (const auto& material : model_.materials)
            if (!material.extensions.empty()) model_.extensionsUsed = {"KHR_materials_unlit"};
        std::vector<Primitive> primitives(materials.size());
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const std::size_t material = std::min<std::size_t>(mesh_.material[t], materials.size() - 1);
            for (int i = 0; i < 3; ++i)
                primitives[material].add(
                    mesh_.triangles[t][i], mesh_.position_world[mesh_.triangles[t][i]],
                    mesh_.normal_world[t][i],
                    mesh_.color.empty() ? std::nullopt : std::optional(mesh_.color[t][i]));
        }
        gltf::Mesh mesh;
        mesh.name = "surface";
        for (std::size_t m = 0; m < primitives.size(); ++m)
            if (!primitives[m].indices.empty()) mesh.primitives.push_back(primitiveOf(primitives[m], m));
        model_.meshes.push_back(std::move(mesh));
        gltf::Node node;
        node.name = "surface";
        node.mesh = 0;
        addNode(std::move(node));
    }

    gltf::Primitive primitiveOf(const Primitive& from, std::size_t material) {
        gltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = static_cast<int>(material);
        primitive.attributes["POSITION"] = addVectors(from.positions, true);
        primitive.attributes["NORMAL"] = addVectors(from.normals, false);
        if (!from.colors.empty()) primitive.attributes["COLOR_0"] = addVectors(from.colors, false);
        primitive.indices = addAccessor(from.indices.data(), from.indices.size() * sizeof(std::uint32_t),
                                        from.indices.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                        TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        return primitive;
    }

    int addVectors(const std::vector<float>& from, bool bounds) {
        const int index =
            addAccessor(from.data(), from.size() * sizeof(float), from.size() / 3,
                        TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
        if (!bounds) return index;
        gltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
        accessor.minValues = accessor.maxValues = {from[0], from[1], from[2]};
        for (std::size_t i = 0; i < from.size(); ++i) {
            accessor.minValues[i % 3] = std::min<double>(accessor.minValues[i % 3], from[i]);
            accessor.maxValues[i % 3] = std::max<double>(accessor.maxValues[i % 3], from[i]);
        }
        return index;
    }

    int addAccessor(const void* data, std::size_t bytes, std::size_t count, int component, int type,
                    int target) {
        std::vector<unsigned char>& buffer = model_.buffers[0].data;
        gltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = buffer.size();
        view.byteLength = bytes;
        view.target = target;
        const auto* first = static_cast<const unsigned char*>(data);
        buffer.insert(buffer.end(), first, first + bytes);
        gltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.componentType = component;
        accessor.type = type;
        accessor.count = count;
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size() - 1);
    }

    void addCameras() {
        for (const Camera& from : scene_.cameras) {
            gltf::Camera camera;
            camera.name = from.name;
            camera.type = from.perspective ? "perspective" : "orthographic";
            camera.perspective.yfov = from.yfov;
            camera.perspective.znear = camera.orthographic.znear = from.znear;
            camera.perspective.zfar = camera.orthographic.zfar = from.zfar.value_or(0.0);
            camera.orthographic.ymag = from.ymag;
            camera.orthographic.xmag = from.xmag > 0.0 ? from.xmag : from.ymag;
            gltf::Node node;
            node.name = from.name;
            node.camera = static_cast<int>(model_.cameras.size());
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row) node.matrix.push_back(from.world_from_camera[column][row]);
            model_.cameras.push_back(std::move(camera));
            addNode(std::move(node));
        }
    }

    void addLights() {
        if (scene_.lights.empty()) return;
        model_.extensionsUsed.push_back("KHR_lights_punctual");
        for (const Light& from : scene_.lights) {
            gltf::Light light;
            light.name = from.name;
            light.type = from.type == Light::Type::kDirectional ? "directional" : "point";
            light.color = list(from.color);
            light.intensity = from.intensity;
            gltf::Node node;
            node.translation = list(from.position_world);
            node.rotation = turnTo(from.direction_world);
            node.extensions["KHR_lights_punctual"] = gltf::Value(
                gltf::Value::Object{{"light", gltf::Value(static_cast<int>(model_.lights.size()))}});
            model_.lights.push_back(std::move(light));
            addNode(std::move(node));
        }
    }

    /// The quaternion (x, y, z, w) that turns -z to a unit direction.
    static std::vector<double> turnTo(const glm::dvec3& to) {
        const double w = 1.0 - to.z;
        if (w < 1e-12) return {1.0, 0.0, 0.0, 0.0};
        // The axis is cross(-z, to).
        const glm::dvec4 q = glm::normalize(glm::dvec4(to.y, -to.x, 0.0, w));
        return {q.x, q.y, q.z, q.w};
    }

    const sdf::SurfaceMesh& mesh_;
    const Scene& scene_;
    gltf::Model model_;
};

}  // namespace

void writeMesh(const std::filesystem::path& path, const sdf::SurfaceMesh& mesh, const Scene& scene,
               const std::string& command) {
    writeAtomically(path, Writer(mesh, scene).run(command));
}

}  // namespace edgewise
