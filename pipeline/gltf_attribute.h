// Vertex attributes of a checked glTF: which formats each may have, and their numbers.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>

#include "pipeline/gltf_accessor.h"

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace edgewise {

/// Which component types an attribute may have, as bits: plain | normalized, core | KHR_mesh_quantization.
struct AttributeFormats {
    unsigned plain = 0, normalized = 0, quantized_plain = 0, quantized_normalized = 0;
};

/// The bit of a component type in AttributeFormats.
constexpr unsigned componentBit(int component_type) {
    return 1u << (component_type - 5120);
}
constexpr unsigned kByteBit = componentBit(5120), kUbyteBit = componentBit(5121),
                   kShortBit = componentBit(5122), kUshortBit = componentBit(5123),
                   kUintBit = componentBit(5125), kFloatBit = componentBit(5126);

/// Reads attributes of one primitive: POSITION and its like, of the base mesh or of a morph target.
class AttributeReader {
  public:
    /// `where` names the primitive in errors; every attribute has `vertices` elements; `quantized`:
    /// KHR_mesh_quantization is in use.
    AttributeReader(const tinygltf::Model& model, const std::string& source, std::string where,
                    std::size_t vertices, bool quantized)
        : model_(model),
          source_(source),
          where_(std::move(where)),
          vertices_(vertices),
          quantized_(quantized) {}

    /// None if `attributes` lacks it. `part` goes before its name in errors: "attributes", "targets[2]".
    /// Throws InputError for a format (of tinygltf's types `types`) or a count that does not fit.
    std::optional<AccessorNumbers> read(const std::map<std::string, int>& attributes, const std::string& part,
                                        const std::string& name, std::initializer_list<int> types,
                                        const AttributeFormats& formats) const;

    /// Throws InputError unless the accessor has one of the formats.
    void checkFormat(const std::string& name, const tinygltf::Accessor& accessor,
                     std::initializer_list<int> types, const AttributeFormats& formats) const;

    /// InputError "WHERE.PART: WHY".
    [[noreturn]] void fail(const std::string& part, const std::string& why) const;

    const std::string& where() const { return where_; }

  private:
    const tinygltf::Model& model_;
    const std::string& source_;
    std::string where_;
    std::size_t vertices_;
    bool quantized_;
};

}  // namespace edgewise
