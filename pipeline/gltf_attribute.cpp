#include "pipeline/gltf_attribute.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <algorithm>

#include "pipeline/error.h"

namespace edgewise {

void AttributeReader::fail(const std::string& part, const std::string& why) const {
    throw InputError(fmt::format("{}.{}", where_, part), why);
}

void AttributeReader::checkFormat(const std::string& name, const tinygltf::Accessor& accessor,
                                  std::initializer_list<int> types, const AttributeFormats& formats) const {
    const unsigned core = accessor.normalized ? formats.normalized : formats.plain;
    const unsigned more = accessor.normalized ? formats.quantized_normalized : formats.quantized_plain;
    const unsigned found = componentBit(accessor.componentType);
    const bool has_type = std::find(types.begin(), types.end(), accessor.type) != types.end();
    if (has_type && ((core | (quantized_ ? more : 0u)) & found) != 0) return;
    fail(name, fmt::format("may not have component type {}{} and {} components{}", accessor.componentType,
                           accessor.normalized ? " normalized" : "",
                           tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)),
                           has_type && (more & found) != 0 ? " without KHR_mesh_quantization" : ""));
}

std::optional<AccessorNumbers> AttributeReader::read(const std::map<std::string, int>& attributes,
                                                     const std::string& part, const std::string& name,
                                                     std::initializer_list<int> types,
                                                     const AttributeFormats& formats) const {
    const auto found = attributes.find(name);
    if (found == attributes.end()) return std::nullopt;
    const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(found->second)];
    const std::string full_name = fmt::format("{}.{}", part, name);
    checkFormat(full_name, accessor, types, formats);
    if (accessor.count != vertices_)
        fail(full_name, fmt::format("has {} elements, POSITION has {}", accessor.count, vertices_));
    return readNumbers(model_, found->second, source_);
}

}  // namespace edgewise
