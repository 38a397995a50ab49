#include "pipeline/gltf_accessor.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "pipeline/error.h"

namespace edgewise {
namespace {

template <class T>
double load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

/// Calls use with a value of the C++ type of a component.
template <class Use>
void withComponent(int component_type, const Use& use) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return use(std::int8_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return use(std::uint8_t{});
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return use(std::int16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return use(std::uint16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return use(std::uint32_t{});
        default:
            return use(float{});
    }
}

struct Source {
    const unsigned char* bytes;
    std::size_t stride;
};

const unsigned char* bytesOf(const tinygltf::Model& model, int view, std::size_t offset) {
    const tinygltf::BufferView& found = model.bufferViews[static_cast<std::size_t>(view)];
    return model.buffers[static_cast<std::size_t>(found.buffer)].data.data() + found.byteOffset + offset;
}

std::vector<double> readPacked(const Source& source, int component_type, std::size_t count, int components) {
    std::vector<double> numbers(count * static_cast<std::size_t>(components));
    withComponent(component_type, [&](auto kind) {
        using T = decltype(kind);
        double* out = numbers.data();
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c)
                *out++ = load<T>(source.bytes + i * source.stride + c * sizeof(T));
    });
    return numbers;
}

std::size_t elementBytes(int component_type, int components) {
    return static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)) * components);
}

std::vector<double> readDense(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                              int components) {
    if (accessor.bufferView < 0)
        return std::vector<double>(accessor.count * static_cast<std::size_t>(components));
    const std::size_t stride = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    const Source source{bytesOf(model, accessor.bufferView, accessor.byteOffset),
                        stride ? stride : elementBytes(accessor.componentType, components)};
    return readPacked(source, accessor.componentType, accessor.count, components);
}

std::vector<double> readSparsePart(const tinygltf::Model& model, int view, int offset, int component_type,
                                   std::size_t count, int components) {
    return readPacked(
        {bytesOf(model, view, static_cast<std::size_t>(offset)), elementBytes(component_type, components)},
        component_type, count, components);
}

void replaceSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& where,
                   AccessorNumbers& numbers) {
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto indices = readSparsePart(model, sparse.indices.bufferView, sparse.indices.byteOffset,
                                        sparse.indices.componentType, count, 1);
    const auto values = readSparsePart(model, sparse.values.bufferView, sparse.values.byteOffset,
                                       accessor.componentType, count, numbers.components);
    double previous = -1.0;
    const auto width = static_cast<std::size_t>(numbers.components);
    for (std::size_t i = 0; i < count; previous = indices[i++]) {
        if (indices[i] >= static_cast<double>(numbers.count))
            throw InputError(where + ".sparse",
                             fmt::format("index {} is out of range: the accessor has {} elements", indices[i],
                                         numbers.count));
        if (indices[i] <= previous)
            throw InputError(where + ".sparse", fmt::format("index {} follows {}", indices[i], previous));
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                    numbers.stored.begin() + static_cast<std::ptrdiff_t>(indices[i]) * numbers.components);
    }
}

void normalize(int component_type, AccessorNumbers& numbers) {
    withComponent(component_type, [&](auto kind) {
        numbers.divisor = static_cast<double>(std::numeric_limits<decltype(kind)>::max());
    });
    for (double& number : numbers.stored) number = std::max(number, -numbers.divisor);
}

void needFinite(const AccessorNumbers& numbers, const std::string& where) {
    const auto bad = std::find_if(numbers.stored.begin(), numbers.stored.end(),
                                  [](double x) { return !std::isfinite(x); });
    if (bad == numbers.stored.end()) return;
    throw InputError(where, fmt::format("element {} is {}, not finite",
                                        (bad - numbers.stored.begin()) / numbers.components, *bad));
}

}  // namespace

AccessorNumbers readNumbers(const tinygltf::Model& model, int index, const std::string& source) {
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    const std::string where = fmt::format("{}: accessors[{}]", source, index);
    AccessorNumbers numbers;
    numbers.count = accessor.count;
    numbers.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (accessor.bufferView < 0 && accessor.count > kMaxUnbackedElements)
        throw FailureError(where, fmt::format("{} elements without a buffer view, the limit is {}",
                                              accessor.count, kMaxUnbackedElements));
    numbers.stored = readDense(model, accessor, numbers.components);
    if (accessor.sparse.isSparse) replaceSparse(model, accessor, where, numbers);
    if (accessor.normalized) normalize(accessor.componentType, numbers);
    needFinite(numbers, where);
    return numbers;
}

}  // namespace edgewise
