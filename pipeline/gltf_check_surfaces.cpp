// Meshes and what they look like: attributes, materials, textures, images, samplers.
#include <array>

#include "pipeline/gltf_check.h"
#include "pipeline/gltf_document.h"
#include "pipeline/gltf_draco.h"
#include "pipeline/gltf_files.h"

namespace edgewise {
namespace {

void checkImage(const GltfElement& image, const GltfCounts& counts, const GltfDocument& document) {
    const auto uri = image.find("uri");
    const auto view = image.referenceIf("bufferView", counts.buffer_views, "buffer views");
    if (uri.has_value() == view.has_value()) image.fail("needs either a uri or a bufferView");
    if (const auto mime = image.find("mimeType")) mime->string();
    if (!uri) return;
    const std::string text = uri->string();
    if (isDataUri(text))
        base64Payload(text, uri->where());
    else
        jailedPath(document.folder, text, uri->where());
}

/// Values that are none of glTF's draw like the default, as viewers do.
void checkSampler(const GltfElement& sampler) {
    for (const char* key : {"magFilter", "minFilter", "wrapS", "wrapT"})
        if (const auto value = sampler.find(key)) value->integer();
}

void checkTexture(const GltfElement& texture, const GltfCounts& counts) {
    texture.referenceIf("source", counts.images, "images");
    texture.referenceIf("sampler", counts.samplers, "samplers");
    for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu"})
        if (const auto other = texture.extension(name)) other->referenceIf("source", counts.images, "images");
}

void checkTextureTransform(const GltfElement& transform) {
    transform.moderatesIf("offset", 2);
    transform.moderatesIf("scale", 2);
    transform.moderateIf("rotation");
    transform.integerOr("texCoord", 0);
}

void checkTextureInfo(const GltfElement& owner, const char* key, const GltfCounts& counts) {
    const auto info = owner.find(key);
    if (!info) return;
    info->object().need("index").reference(counts.textures, "textures");
    info->integerOr("texCoord", 0);
    if (const auto transform = info->extension("KHR_texture_transform")) checkTextureTransform(*transform);
}

void checkUnit(const GltfElement& value) {
    if (value.number() < 0.0 || value.number() > 1.0)
        value.fail(fmt::format("{} is not in [0, 1]", value.number()));
}

void checkUnits(const GltfElement& owner, const char* key, std::size_t count) {
    const auto factor = owner.find(key);
    if (!factor) return;
    factor->numbers(count);
    for (std::size_t i = 0; i < count; ++i) checkUnit(factor->at(i));
}

void checkUnitIf(const std::optional<GltfElement>& owner, const char* key) {
    if (!owner) return;
    if (const auto value = owner->find(key)) checkUnit(*value);
}

void checkNotNegative(const std::optional<GltfElement>& value) {
    if (value && value->moderate() < 0.0) value->fail(fmt::format("{} is negative", value->number()));
}

void checkMetallicRoughness(const GltfElement& pbr, const GltfCounts& counts) {
    checkUnits(pbr.object(), "baseColorFactor", 4);
    checkUnitIf(pbr, "metallicFactor");
    checkUnitIf(pbr, "roughnessFactor");
    checkTextureInfo(pbr, "baseColorTexture", counts);
    checkTextureInfo(pbr, "metallicRoughnessTexture", counts);
}

void checkMaterial(const GltfElement& material, const GltfCounts& counts) {
    if (const auto pbr = material.find("pbrMetallicRoughness")) checkMetallicRoughness(*pbr, counts);
    for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        checkTextureInfo(material, texture, counts);
    if (const auto normal = material.find("normalTexture")) normal->moderateIf("scale");
    checkUnitIf(material.find("occlusionTexture"), "strength");
    checkUnits(material, "emissiveFactor", 3);
    if (const auto emissive = material.extension("KHR_materials_emissive_strength"))
        checkNotNegative(emissive->find("emissiveStrength"));
    if (const auto mode = material.find("alphaMode")) mode->string();
    checkNotNegative(material.find("alphaCutoff"));
    material.booleanOr("doubleSided", false);
    material.extension("KHR_materials_unlit");
}

void checkAttributes(const GltfElement& attributes, const GltfCounts& counts) {
    attributes.object();
    for (const auto& [name, value] : attributes.json().items())
        attributes.need(name.c_str()).reference(counts.accessors, "accessors");
}

void checkPrimitive(const GltfElement& primitive, const GltfCounts& counts) {
    const GltfElement attributes = primitive.object().need("attributes");
    checkAttributes(attributes, counts);
    if (attributes.size() == 0) attributes.fail("is empty");
    primitive.referenceIf("indices", counts.accessors, "accessors");
    primitive.referenceIf("material", counts.materials, "materials");
    primitive.integerOr("mode", 4);
    checkDraco(primitive, counts);
    primitive.each("targets", [&](const GltfElement& target) { checkAttributes(target, counts); });
}

void checkMesh(const GltfElement& mesh, const GltfCounts& counts) {
    if (mesh.need("primitives").array().size() == 0) mesh.fail("has no primitives");
    if (const auto weights = mesh.find("weights")) mesh.moderatesIf("weights", weights->array().size());
    mesh.each("primitives", [&](const GltfElement& primitive) { checkPrimitive(primitive, counts); });
}

}  // namespace

void checkSurfaces(const GltfElement& root, const GltfCounts& counts, const GltfDocument& document) {
    root.each("images", [&](const GltfElement& image) { checkImage(image, counts, document); });
    root.each("samplers", checkSampler);
    root.each("textures", [&](const GltfElement& texture) { checkTexture(texture, counts); });
    root.each("materials", [&](const GltfElement& material) { checkMaterial(material, counts); });
    root.each("meshes", [&](const GltfElement& mesh) { checkMesh(mesh, counts); });
}

}  // namespace edgewise
