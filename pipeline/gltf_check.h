// The checks a glTF passes before any library reads it: schema, references, ranges, hierarchy.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "pipeline/gltf_element.h"

namespace edgewise {

struct GltfDocument;

/// Checks a document against everything later stages rely on; stops at the first problem, an InputError.
/// Whole numbers written as 3.0 become 3 in the document.
void checkGltf(GltfDocument& document);

/// True if edgewise draws what the extension says.
bool isSupportedExtension(std::string_view name);

/// Bytes of one component (5120 BYTE ... 5126 FLOAT).
std::uint64_t componentBytes(std::uint64_t component_type);

/// Cameras of other types are ignored.
bool isKnownCamera(const GltfElement& camera);

/// How many elements each section of the file has: what references may point to.
struct GltfCounts {
    std::size_t accessors, buffers, buffer_views, cameras, images, materials, meshes, nodes, samplers, scenes,
        skins, textures;
};

/// For each buffer, whether it has bytes; one without is a placeholder for what compressed views hold.
std::vector<bool> checkBuffers(const GltfElement& root, const GltfDocument& document);

/// The parts of checkGltf, each in a file of its own.
void checkData(const GltfElement& root, const GltfDocument& document);
void checkSurfaces(const GltfElement& root, const GltfCounts& counts, const GltfDocument& document);
void checkHierarchy(const GltfElement& root, const GltfCounts& counts);

}  // namespace edgewise
