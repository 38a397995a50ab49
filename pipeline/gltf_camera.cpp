#include "pipeline/gltf_camera.h"

#include "pipeline/gltf_check.h"
#include "pipeline/gltf_ignored.h"
#include "pipeline/gltf_transform.h"

namespace edgewise {
namespace {

std::optional<double> numberIf(const GltfElement& owner, const char* key) {
    const auto found = owner.find(key);
    return found ? std::optional(found->number()) : std::nullopt;
}

void readLens(const GltfElement& from, Camera& camera) {
    camera.perspective = from.need("type").string() == "perspective";
    const GltfElement lens = from.need(camera.perspective ? "perspective" : "orthographic");
    camera.znear = lens.need("znear").number();
    camera.zfar = numberIf(lens, "zfar");
    if (camera.perspective) {
        camera.yfov = lens.need("yfov").number();
        camera.aspect = numberIf(lens, "aspectRatio");
    } else {
        camera.xmag = lens.need("xmag").number();
        camera.ymag = lens.need("ymag").number();
    }
}

std::string nameOf(const GltfElement& element) {
    const auto name = element.find("name");
    return name ? name->string() : "";
}

}  // namespace

void addCamera(const GltfElement& root, const PlacedNode& placed, Scene& scene) {
    const GltfElement node = root.need("nodes").at(static_cast<std::size_t>(placed.node));
    const auto reference = node.find("camera");
    if (!reference) return;
    const GltfElement from = root.need("cameras").at(static_cast<std::size_t>(reference->integer()));
    if (!isKnownCamera(from)) return countIgnored(scene, "cameras of an unknown type");
    const auto rigid = rigidTransform(placed.world_from_node);
    if (!rigid) node.fail("its camera has no orientation: an axis of the node vanishes");
    Camera camera;
    readLens(from, camera);
    camera.name = nameOf(from).empty() ? nameOf(node) : nameOf(from);
    camera.node = static_cast<std::uint32_t>(placed.node);
    camera.world_from_camera = *rigid;
    scene.cameras.push_back(camera);
}

}  // namespace edgewise
