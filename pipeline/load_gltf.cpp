#include "pipeline/load_gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "pipeline/error.h"
#include "pipeline/gltf_check.h"
#include "pipeline/gltf_document.h"
#include "pipeline/gltf_files.h"
#include "pipeline/gltf_ignored.h"
#include "pipeline/gltf_material.h"
#include "pipeline/gltf_primitive.h"
#include "pipeline/gltf_transform.h"

namespace edgewise {
namespace {

/// A non-negative whole number, if the text is nothing else.
std::optional<std::size_t> wholeNumber(const std::string& text) {
    std::size_t value = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

std::size_t chosenScene(const tinygltf::Model& model, const std::string& wanted, const std::string& source) {
    if (wanted.empty()) return model.defaultScene >= 0 ? static_cast<std::size_t>(model.defaultScene) : 0;
    for (std::size_t i = 0; i < model.scenes.size(); ++i)
        if (model.scenes[i].name == wanted) return i;
    const auto index = wholeNumber(wanted);
    if (index && *index < model.scenes.size()) return *index;
    throw InputError("--scene " + wanted, fmt::format("{} has {} scenes, none of that name or index", source,
                                                      model.scenes.size()));
}

std::vector<int> rootNodes(const tinygltf::Model& model, const std::string& wanted,
                           const std::string& source) {
    if (!model.scenes.empty() || !wanted.empty())
        return model.scenes[chosenScene(model, wanted, source)].nodes;
    std::vector<bool> has_parent(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children) has_parent[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        if (!has_parent[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

class SceneReader {
  public:
    SceneReader(const tinygltf::Model& model, bool quantized, const LoadOptions& options, Scene& scene)
        : model_(model),
          quantized_(quantized),
          options_(options),
          scene_(scene),
          used_materials_(model.materials.size(), false),
          visited_(model.nodes.size(), false) {}

    void read() {
        for (const tinygltf::Node& node : model_.nodes) scene_.node_names.push_back(node.name);
        for (const tinygltf::Mesh& mesh : model_.meshes) scene_.mesh_names.push_back(mesh.name);
        scene_.bounds_min = glm::dvec3(std::numeric_limits<double>::infinity());
        scene_.bounds_max = -scene_.bounds_min;
        visitNodes();
        if (!(scene_.bounds_min.x <= scene_.bounds_max.x))
            scene_.bounds_min = scene_.bounds_max = glm::dvec3(0.0);
        readMaterials(model_, used_materials_, scene_.source, scene_);
        fillMissingUv();
        if (options_.progress) options_.progress(1.0);
    }

  private:
    struct Pending {
        int node;
        glm::dmat4 world_from_parent;
    };

    /// Iterative: hierarchies may be 100,000 deep. A scene's nodes are its roots, even one that has a parent
    /// outside the scene (whose transform then does not count); one below another listed node is refused.
    void visitNodes() {
        std::vector<Pending> pending;
        const std::vector<int> roots = rootNodes(model_, options_.scene, scene_.source);
        for (auto root = roots.rbegin(); root != roots.rend(); ++root)
            pending.push_back({*root, glm::dmat4(1.0)});
        for (std::size_t visited = 0; !pending.empty(); ++visited) {
            const Pending current = pending.back();
            pending.pop_back();
            const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(current.node)];
            const glm::dmat4 world_from_node = current.world_from_parent * localTransform(node);
            if (visited_[static_cast<std::size_t>(current.node)])
                throw InputError(nodeName(current.node), "the scene lists it and one of its ancestors");
            visited_[static_cast<std::size_t>(current.node)] = true;
            visitNode(current.node, world_from_node);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                pending.push_back({*child, world_from_node});
            report(visited);
        }
    }

    void report(std::size_t visited) const {
        if (options_.progress)
            options_.progress(static_cast<double>(visited + 1) / static_cast<double>(model_.nodes.size()));
    }

    void visitNode(int index, const glm::dmat4& world_from_node) {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
        if (!isFinite(world_from_node))
            throw InputError(nodeName(index), "its world transform is not finite");
        if (node.camera >= 0) addCamera(index, world_from_node);
        if (node.mesh < 0) return;
        const auto& primitives = model_.meshes[static_cast<std::size_t>(node.mesh)].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (drawsTriangles(primitives[i])) addPrimitive(index, static_cast<int>(i), world_from_node);
    }

    std::string nodeName(int index) const { return fmt::format("{}: nodes[{}]", scene_.source, index); }

    void addCamera(int index, const glm::dmat4& world_from_node) {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
        const tinygltf::Camera& from = model_.cameras[static_cast<std::size_t>(node.camera)];
        const auto rigid = rigidTransform(world_from_node);
        if (!rigid)
            throw InputError(nodeName(index), "its camera has no orientation: an axis of the node vanishes");
        Camera camera;
        camera.name = from.name.empty() ? node.name : from.name;
        camera.node = static_cast<std::uint32_t>(index);
        camera.world_from_camera = *rigid;
        camera.perspective = from.type == "perspective";
        const tinygltf::PerspectiveCamera& lens = from.perspective;
        camera.yfov = lens.yfov;
        camera.xmag = from.orthographic.xmag;
        camera.ymag = from.orthographic.ymag;
        camera.znear = camera.perspective ? lens.znear : from.orthographic.znear;
        if (!camera.perspective)
            camera.zfar = from.orthographic.zfar;
        else if (lens.zfar != 0.0)
            camera.zfar = lens.zfar;
        if (camera.perspective && lens.aspectRatio != 0.0) camera.aspect = lens.aspectRatio;
        scene_.cameras.push_back(camera);
    }

    void addPrimitive(int node, int primitive, const glm::dmat4& world_from_node) {
        const int mesh = model_.nodes[static_cast<std::size_t>(node)].mesh;
        const tinygltf::Primitive& from =
            model_.meshes[static_cast<std::size_t>(mesh)].primitives[static_cast<std::size_t>(primitive)];
        countPrimitive(node, primitiveSize(model_, from));
        Geometry geometry = readPrimitive({model_, scene_.source, quantized_, mesh, primitive});
        geometry.node = static_cast<std::uint32_t>(node);
        geometry.mesh = static_cast<std::uint32_t>(mesh);
        geometry.primitive = static_cast<std::uint32_t>(primitive);
        geometry.material = from.material < 0 ? static_cast<std::uint32_t>(model_.materials.size())
                                              : static_cast<std::uint32_t>(from.material);
        if (from.material >= 0) used_materials_[geometry.material] = true;
        geometry.first_triangle = static_cast<std::uint32_t>(scene_.triangle_count);
        scene_.triangle_count += geometry.triangles.size();
        place(geometry, world_from_node);
        if (!geometry.triangles.empty()) scene_.geometry.push_back(std::move(geometry));
    }

    void countPrimitive(int node, const PrimitiveSize& size) {
        vertex_count_ += size.vertices;
        if (scene_.triangle_count + size.triangles > kMaxTriangles || vertex_count_ > kMaxVertices)
            throw FailureError(nodeName(node),
                               fmt::format("the scene has more than {} triangles or {} vertices",
                                           kMaxTriangles, kMaxVertices));
        if (size.left_over != 0) countIgnored(scene_, "vertices of incomplete triangles", size.left_over);
    }

    void place(Geometry& geometry, const glm::dmat4& world_from_node) {
        for (glm::dvec3& position : geometry.position_world) {
            position = glm::dvec3(world_from_node * glm::dvec4(position, 1.0));
            if (!(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)))
                throw InputError(nodeName(static_cast<int>(geometry.node)),
                                 "a vertex is not finite in world space");
        }
        if (geometry.world_from_file) geometry.world_from_file = world_from_node;
        const glm::dmat3 normals = normalTransform(world_from_node);
        for (glm::dvec3& normal : geometry.normal_world) normal = normals * normal;
        if (flipsWinding(world_from_node))
            for (auto& triangle : geometry.triangles) std::swap(triangle[1], triangle[2]);
        growBounds(geometry);
    }

    /// Vertices no triangle uses do not count.
    void growBounds(const Geometry& geometry) {
        for (const auto& triangle : geometry.triangles)
            for (const std::uint32_t vertex : triangle) {
                scene_.bounds_min = glm::min(scene_.bounds_min, geometry.position_world[vertex]);
                scene_.bounds_max = glm::max(scene_.bounds_max, geometry.position_world[vertex]);
            }
    }

    void fillMissingUv() {
        for (Geometry& geometry : scene_.geometry) {
            const Material& material = scene_.materials[geometry.material];
            auto& uv = geometry.uv[static_cast<std::size_t>(material.base_color_map.uv)];
            if (material.base_color_map.present() && uv.empty()) uv.resize(geometry.position_world.size());
        }
    }

    const tinygltf::Model& model_;
    const bool quantized_;
    const LoadOptions& options_;
    Scene& scene_;
    std::vector<bool> used_materials_, visited_;
    std::size_t vertex_count_ = 0;
};

bool usesExtension(const tinygltf::Model& model, const char* name) {
    const auto in = [&](const std::vector<std::string>& list) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    return in(model.extensionsUsed) || in(model.extensionsRequired);
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options) {
    GltfDocument document = readGltfDocument(path);
    checkGltf(document);
    Scene scene;
    scene.source = document.source;
    scene.ignored = listIgnored(document.root);
    const tinygltf::Model model = readModel(document);
    document.root = nullptr;
    SceneReader(model, usesExtension(model, "KHR_mesh_quantization"), options, scene).read();
    return scene;
}

}  // namespace edgewise
