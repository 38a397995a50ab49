// EXT_meshopt_compression and KHR_meshopt_compression: buffer views whose bytes are compressed.
#pragma once

#include <string>

#include "pipeline/gltf_element.h"
#include "pipeline/scene.h"

namespace tinygltf {
class Model;
}

namespace edgewise {

struct GltfCounts;

/// The extension of a buffer view, by either of its names.
std::optional<GltfElement> meshoptOf(const GltfElement& view);

/// Checks the extension of a buffer view against the extension's rules, and that its compressed bytes exist
/// and are not fewer than the codec needs at least: a part of checkGltf. `has_data[b]`: buffers[b] has bytes.
void checkMeshopt(const GltfElement& view, const GltfElement& root, const std::vector<bool>& has_data);

/// Decodes every compressed view into a buffer of its own. Where a view cannot be decoded but its buffer has
/// the plain bytes, those stay (counted as ignored). Throws InputError naming the view otherwise. `has_data`
/// as above.
void unpackMeshopt(const GltfElement& root, const std::vector<bool>& has_data, tinygltf::Model& model,
                   Scene& scene);

}  // namespace edgewise
