#include "pipeline/load_gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "pipeline/error.h"
#include "pipeline/gltf_accessor.h"
#include "pipeline/gltf_animation.h"
#include "pipeline/gltf_camera.h"
#include "pipeline/gltf_check.h"
#include "pipeline/gltf_document.h"
#include "pipeline/gltf_draco.h"
#include "pipeline/gltf_files.h"
#include "pipeline/gltf_hierarchy.h"
#include "pipeline/gltf_ignored.h"
#include "pipeline/gltf_instancing.h"
#include "pipeline/gltf_lights.h"
#include "pipeline/gltf_material.h"
#include "pipeline/gltf_meshopt.h"
#include "pipeline/gltf_place.h"
#include "pipeline/gltf_primitive.h"

namespace edgewise {
namespace {

class SceneReader {
  public:
    SceneReader(const GltfElement& root, const tinygltf::Model& model, bool quantized,
                const LoadOptions& options, Scene& scene)
        : root_(root),
          model_(model),
          quantized_(quantized),
          options_(options),
          scene_(scene),
          material_count_(root.has("materials") ? root.need("materials").size() : 0),
          used_materials_(material_count_, false) {}

    void read() {
        for (const tinygltf::Node& node : model_.nodes) scene_.node_names.push_back(node.name);
        for (const tinygltf::Mesh& mesh : model_.meshes) scene_.mesh_names.push_back(mesh.name);
        scene_.bounds_min = glm::dvec3(std::numeric_limits<double>::infinity());
        scene_.bounds_max = -scene_.bounds_min;
        placed_ = depthFirstNodes(model_, options_.scene, scene_.source);
        for (const PlacedNode& placed : placed_) countNode(placed.node);
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            readNode(placed_[i]);
            if (options_.progress)
                options_.progress(static_cast<double>(i + 1) / static_cast<double>(placed_.size()));
        }
        if (!(scene_.bounds_min.x <= scene_.bounds_max.x))
            scene_.bounds_min = scene_.bounds_max = glm::dvec3(0.0);
        readMaterials(root_, model_, used_materials_, options_.limits.image_texels, scene_);
        fillMissingUv();
        if (options_.progress) options_.progress(1.0);
    }

  private:
    void readNode(const PlacedNode& placed) {
        addCamera(root_, placed, scene_);
        addLight(root_, placed, scene_);
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(placed.node)];
        if (node.mesh < 0) return;
        std::vector<LocalPrimitive> locals = readMesh(node);
        const auto instances = instancesOf(placed.node);
        for (std::size_t i = 0; i < instances.size(); ++i) {
            const PlacedNode instance{placed.node, placed.world_from_node * instances[i]};
            for (LocalPrimitive& local : locals)
                addPrimitive(instance, static_cast<std::uint32_t>(i),
                             i + 1 < instances.size() ? local : std::move(local));
        }
    }

    /// A skin says where its vertices are, whatever the instance.
    std::vector<glm::dmat4> instancesOf(int index) {
        const auto i = static_cast<std::size_t>(index);
        if (model_.nodes[i].skin < 0) return instanceTransforms(root_, model_, i, scene_.source);
        if (root_.need("nodes").at(i).extension("EXT_mesh_gpu_instancing"))
            countIgnored(scene_, "instances of a skinned node");
        return {glm::dmat4(1.0)};
    }

    std::vector<LocalPrimitive> readMesh(const tinygltf::Node& node) {
        const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
        std::vector<LocalPrimitive> locals;
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const tinygltf::Primitive& from = mesh.primitives[i];
            if (!drawsTriangles(from)) continue;
            locals.push_back(readPrimitive({model_, scene_.source, quantized_, node.mesh, static_cast<int>(i),
                                            node.weights.empty() ? mesh.weights : node.weights}));
            Geometry& geometry = locals.back().geometry;
            geometry.mesh = static_cast<std::uint32_t>(node.mesh);
            geometry.primitive = static_cast<std::uint32_t>(i);
            geometry.material = static_cast<std::uint32_t>(
                from.material < 0 ? material_count_ : static_cast<std::size_t>(from.material));
            if (from.material >= 0) used_materials_[geometry.material] = true;
        }
        return locals;
    }

    std::string nodeName(int index) const { return fmt::format("{}: nodes[{}]", scene_.source, index); }

    void addPrimitive(const PlacedNode& placed, std::uint32_t instance, LocalPrimitive made) {
        Geometry& geometry = made.geometry;
        geometry.node = static_cast<std::uint32_t>(placed.node);
        geometry.instance = instance;
        geometry.first_triangle = static_cast<std::uint32_t>(scene_.triangle_count);
        scene_.triangle_count += geometry.triangles.size();
        place(made, placed);
        growBounds(geometry);
        if (!geometry.triangles.empty()) scene_.geometry.push_back(std::move(geometry));
    }

    /// Before anything is made room for: small files may ask for a lot by repeating it.
    void countNode(int index) {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
        if (node.mesh < 0) return;
        const std::size_t copies = node.skin >= 0 ? 1 : instanceTotal(root_, static_cast<std::size_t>(index));
        for (const tinygltf::Primitive& primitive :
             model_.meshes[static_cast<std::size_t>(node.mesh)].primitives)
            if (drawsTriangles(primitive)) countPrimitive(index, primitive, copies);
    }

    /// Counts are below 2^32 each: no overflow before the limits stop it.
    void countPrimitive(int node, const tinygltf::Primitive& primitive, std::size_t copies) {
        const PrimitiveSize size = primitiveSize(model_, primitive);
        vertex_count_ += size.vertices * copies;
        triangle_count_ += size.triangles * copies;
        if (!size.has_bytes) unbacked_count_ += size.vertices * copies;
        const LoadLimits& limits = options_.limits;
        if (triangle_count_ > limits.triangles || vertex_count_ > limits.vertices)
            throw FailureError(nodeName(node),
                               fmt::format("the scene has more than {} triangles or {} vertices",
                                           limits.triangles, limits.vertices));
        if (unbacked_count_ > kMaxUnbackedElements)
            throw FailureError(
                nodeName(node),
                fmt::format("the scene has more than {} vertices without bytes", kMaxUnbackedElements));
        if (size.left_over != 0)
            countIgnored(scene_, "vertices of incomplete triangles", size.left_over * copies);
    }

    /// A skin replaces the node's own transform.
    void place(LocalPrimitive& made, const PlacedNode& placed) {
        const int skin = model_.nodes[static_cast<std::size_t>(placed.node)].skin;
        const std::string where = nodeName(placed.node);
        if (skin < 0 || made.influences.empty())
            return placeRigidly(made.geometry, placed.world_from_node, where);
        placeSkinned(made.geometry,
                     blendJoints(made.influences, jointsOf(static_cast<std::size_t>(skin)), where), where);
    }

    const std::vector<glm::dmat4>& jointsOf(std::size_t skin) {
        if (world_of_node_.empty()) world_of_node_ = worldOfEveryNode(model_, placed_);
        const auto [known, is_new] = joints_of_.try_emplace(skin);
        if (is_new) known->second = jointMatrices(root_, model_, skin, world_of_node_, scene_.source);
        return known->second;
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
            for (const TextureUse* use :
                 {&material.base_color_map, &material.metallic_roughness_map, &material.normal_map,
                  &material.occlusion_map, &material.emissive_map}) {
                auto& uv = geometry.uv[static_cast<std::size_t>(use->uv)];
                if (use->present() && uv.empty()) uv.resize(geometry.position_world.size());
            }
        }
    }

    GltfElement root_;
    const tinygltf::Model& model_;
    const bool quantized_;
    const LoadOptions& options_;
    Scene& scene_;
    const std::size_t material_count_;
    std::vector<bool> used_materials_;
    std::vector<PlacedNode> placed_;
    std::vector<glm::dmat4> world_of_node_;
    std::map<std::size_t, std::vector<glm::dmat4>> joints_of_;
    std::uint64_t vertex_count_ = 0, triangle_count_ = 0, unbacked_count_ = 0;
};

bool usesExtension(const nlohmann::json& root, const char* name) {
    const auto in = [&](const char* key) {
        return root.contains(key) && std::find(root[key].begin(), root[key].end(), name) != root[key].end();
    };
    return in("extensionsUsed") || in("extensionsRequired");
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options) {
    GltfDocument document = readGltfDocument(path);
    checkGltf(document);
    Scene scene;
    scene.source = document.source;
    scene.ignored = listIgnored(document.root);
    const GltfElement root(document.root, document.source + ":");
    const std::vector<bool> has_data = checkBuffers(root, document);
    tinygltf::Model model = readModel(document, has_data);
    unpackMeshopt(root, has_data, model, scene);
    unpackDraco(root, model);
    if (options.time) playAnimation(root, options.animation, *options.time, model, scene);
    SceneReader(root, model, usesExtension(document.root, "KHR_mesh_quantization"), options, scene).read();
    return scene;
}

}  // namespace edgewise
