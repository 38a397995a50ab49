#include "pipeline/gltf_morph.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <algorithm>

namespace edgewise {
namespace {

constexpr AttributeFormats kPosition{kFloatBit, 0, kByteBit | kShortBit, kByteBit | kShortBit};
constexpr AttributeFormats kDirection{kFloatBit, 0, 0, kByteBit | kShortBit};

/// Three components; a tangent's sign stays.
template <class Vector>
bool add(const std::optional<AccessorNumbers>& displacements, double weight, std::vector<Vector>& to) {
    if (!displacements || to.empty()) return false;
    for (std::size_t i = 0; i < to.size(); ++i)
        for (int c = 0; c < 3; ++c) to[i][c] += weight * displacements->value(i, c);
    return true;
}

}  // namespace

bool addMorphTargets(const tinygltf::Primitive& primitive, const AttributeReader& reader,
                     const std::vector<double>& weights, Geometry& geometry) {
    bool moved = false;
    for (std::size_t i = 0; i < std::min(weights.size(), primitive.targets.size()); ++i) {
        if (weights[i] == 0.0) continue;
        const auto displacements = [&](const char* name, const AttributeFormats& formats) {
            return reader.read(primitive.targets[i], fmt::format("targets[{}]", i), name,
                               {TINYGLTF_TYPE_VEC3}, formats);
        };
        moved |= add(displacements("POSITION", kPosition), weights[i], geometry.position_world);
        add(displacements("NORMAL", kDirection), weights[i], geometry.normal_world);
        add(displacements("TANGENT", kDirection), weights[i], geometry.tangent_world);
    }
    return moved;
}

}  // namespace edgewise
