#include "pipeline/gltf_instancing.h"

#include <tiny_gltf.h>

#include "pipeline/gltf_accessor.h"
#include "pipeline/gltf_check.h"
#include "pipeline/gltf_transform.h"

namespace edgewise {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

/// One of the three attributes, or none if the node lacks it.
std::optional<AccessorNumbers> readAttribute(const GltfElement& attributes, const char* key, int type,
                                             const tinygltf::Model& model, const std::string& source) {
    const auto reference = attributes.find(key);
    if (!reference) return std::nullopt;
    const auto index = static_cast<int>(reference->integer());
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    const bool is_float = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const bool may_be_small = type == TINYGLTF_TYPE_VEC4 && accessor.normalized;
    if (accessor.type != type || !(is_float || may_be_small))
        reference->fail(fmt::format("accessors[{}] has another format than {} needs", index, key));
    return readNumbers(model, index, source);
}

std::vector<double> elementOf(const std::optional<AccessorNumbers>& numbers, std::size_t i) {
    std::vector<double> element;
    for (int c = 0; numbers && c < numbers->components; ++c) element.push_back(numbers->value(i, c));
    return element;
}

/// How many instances the attributes agree on.
std::size_t instanceCount(const GltfElement& attributes,
                          std::initializer_list<const std::optional<AccessorNumbers>*> all) {
    std::optional<std::size_t> count;
    for (const auto* numbers : all) {
        if (!*numbers) continue;
        if (count && *count != (*numbers)->count)
            attributes.fail(
                fmt::format("an attribute has {} instances, another {}", *count, (*numbers)->count));
        count = (*numbers)->count;
    }
    if (!count) attributes.fail("has none of TRANSLATION, ROTATION and SCALE");
    return *count;
}

}  // namespace

void checkInstancing(const GltfElement& node, const GltfCounts& counts) {
    const auto instancing = node.extension(kExtension);
    if (!instancing) return;
    const GltfElement attributes = instancing->need("attributes").object();
    for (const auto& [name, value] : attributes.json().items())
        attributes.need(name.c_str()).reference(counts.accessors, "accessors");
}

std::size_t instanceTotal(const GltfElement& root, std::size_t node) {
    const auto instancing = root.need("nodes").at(node).extension(kExtension);
    if (!instancing) return 1;
    const GltfElement attributes = instancing->need("attributes");
    for (const char* key : {"TRANSLATION", "ROTATION", "SCALE"})
        if (const auto reference = attributes.find(key))
            return root.need("accessors").at(reference->integer()).need("count").integer();
    return 0;
}

std::vector<glm::dmat4> instanceTransforms(const GltfElement& root, const tinygltf::Model& model,
                                           std::size_t node, const std::string& source) {
    const auto instancing = root.need("nodes").at(node).extension(kExtension);
    if (!instancing) return {glm::dmat4(1.0)};
    const GltfElement attributes = instancing->need("attributes");
    const auto read = [&](const char* key, int type) {
        return readAttribute(attributes, key, type, model, source);
    };
    const auto translation = read("TRANSLATION", TINYGLTF_TYPE_VEC3);
    const auto rotation = read("ROTATION", TINYGLTF_TYPE_VEC4), scale = read("SCALE", TINYGLTF_TYPE_VEC3);
    std::vector<glm::dmat4> transforms;
    for (std::size_t i = 0; i < instanceCount(attributes, {&translation, &rotation, &scale}); ++i) {
        tinygltf::Node instance;
        instance.translation = elementOf(translation, i);
        instance.rotation = elementOf(rotation, i);
        instance.scale = elementOf(scale, i);
        transforms.push_back(localTransform(instance));
        if (!isFinite(transforms.back()))
            attributes.fail(fmt::format("instance {} has the rotation 0, 0, 0, 0", i));
    }
    return transforms;
}

}  // namespace edgewise
