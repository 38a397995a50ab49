// Meshes and what they look like: attributes, materials, textures, images, samplers.
#include <array>

#include "pipeline/gltf_check.h"
#include "pipeline/gltf_document.h"
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

void checkSampler(const GltfElement& sampler) {
    if (const auto filter = sampler.find("magFilter")) filter->integerOf({9728, 9729});
    if (const auto filter = sampler.find("minFilter"))
        filter->integerOf({9728, 9729, 9984, 9985, 9986, 9987});
    for (const char* wrap : {"wrapS", "wrapT"})
        if (const auto mode = sampler.find(wrap)) mode->integerOf({33071, 33648, 10497});
}

void checkTextureInfo(const GltfElement& owner, const char* key, const GltfCounts& counts) {
    const auto info = owner.find(key);
    if (!info) return;
    info->object().need("index").reference(counts.textures, "textures");
    info->integerOr("texCoord", 0);
}

void checkUnitInterval(const GltfElement& owner, const char* key, std::size_t count) {
    const auto factor = owner.find(key);
    if (!factor) return;
    factor->numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double value = factor->at(i).number();
        if (value < 0.0 || value > 1.0) factor->at(i).fail(fmt::format("{} is not in [0, 1]", value));
    }
}

void checkMaterial(const GltfElement& material, const GltfCounts& counts) {
    if (const auto pbr = material.find("pbrMetallicRoughness")) {
        checkUnitInterval(pbr->object(), "baseColorFactor", 4);
        checkTextureInfo(*pbr, "baseColorTexture", counts);
        checkTextureInfo(*pbr, "metallicRoughnessTexture", counts);
    }
    for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        checkTextureInfo(material, texture, counts);
    checkUnitInterval(material, "emissiveFactor", 3);
    if (const auto mode = material.find("alphaMode")) mode->stringOf({"OPAQUE", "MASK", "BLEND"});
    if (const auto cutoff = material.find("alphaCutoff"))
        if (cutoff->number() < 0.0) cutoff->fail(fmt::format("{} is negative", cutoff->number()));
    material.booleanOr("doubleSided", false);
}

void checkAttributes(const GltfElement& attributes, const GltfCounts& counts) {
    attributes.object();
    for (const auto& [name, value] : attributes.json().items())
        attributes.need(name.c_str()).reference(counts.accessors, "accessors");
}

void checkPrimitive(const GltfElement& primitive, const GltfCounts& counts) {
    checkAttributes(primitive.object().need("attributes"), counts);
    primitive.referenceIf("indices", counts.accessors, "accessors");
    primitive.referenceIf("material", counts.materials, "materials");
    if (const auto mode = primitive.find("mode")) mode->integer(0, 6);
    primitive.each("targets", [&](const GltfElement& target) { checkAttributes(target, counts); });
}

void checkMesh(const GltfElement& mesh, const GltfCounts& counts) {
    if (mesh.need("primitives").array().size() == 0) mesh.fail("has no primitives");
    mesh.each("primitives", [&](const GltfElement& primitive) { checkPrimitive(primitive, counts); });
}

}  // namespace

void checkSurfaces(const GltfElement& root, const GltfCounts& counts, const GltfDocument& document) {
    root.each("images", [&](const GltfElement& image) { checkImage(image, counts, document); });
    root.each("samplers", checkSampler);
    root.each("textures", [&](const GltfElement& texture) {
        texture.referenceIf("source", counts.images, "images");
        texture.referenceIf("sampler", counts.samplers, "samplers");
    });
    root.each("materials", [&](const GltfElement& material) { checkMaterial(material, counts); });
    root.each("meshes", [&](const GltfElement& mesh) { checkMesh(mesh, counts); });
}

}  // namespace edgewise
