#include "pipeline/gltf_primitive.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <initializer_list>

#include "pipeline/error.h"
#include "pipeline/gltf_accessor.h"

namespace edgewise {
namespace {

/// Which component types an attribute may have, as bits: plain | normalized, core | KHR_mesh_quantization.
struct Formats {
    unsigned plain, normalized, quantized_plain, quantized_normalized;
};

constexpr unsigned bit(int component_type) {
    return 1u << (component_type - TINYGLTF_COMPONENT_TYPE_BYTE);
}
constexpr unsigned kByte = bit(TINYGLTF_COMPONENT_TYPE_BYTE),
                   kUbyte = bit(TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE),
                   kShort = bit(TINYGLTF_COMPONENT_TYPE_SHORT),
                   kUshort = bit(TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT),
                   kUint = bit(TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT),
                   kFloat = bit(TINYGLTF_COMPONENT_TYPE_FLOAT), kSmall = kByte | kUbyte | kShort | kUshort;
constexpr Formats kPosition{kFloat, 0, kSmall, kSmall};
constexpr Formats kNormal{kFloat, 0, 0, kByte | kShort};
constexpr Formats kUv{kFloat, kUbyte | kUshort, kSmall, kByte | kShort};
constexpr Formats kColor{kFloat, kUbyte | kUshort, 0, 0};
constexpr Formats kIndices{kUbyte | kUshort | kUint, 0, 0, 0};

bool isOneOf(int value, std::initializer_list<int> allowed) {
    for (const int choice : allowed)
        if (value == choice) return true;
    return false;
}

std::size_t vertexCount(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    return model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))].count;
}

/// Corners of triangle t of a list, strip or fan, as the specification orders them (3.7.2.1).
std::array<std::size_t, 3> corners(int mode, std::size_t t) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) return {t, t + 1 + t % 2, t + 2 - t % 2};
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {t + 1, t + 2, 0};
    return {3 * t, 3 * t + 1, 3 * t + 2};
}

class PrimitiveReader {
  public:
    explicit PrimitiveReader(const PrimitiveContext& context)
        : model_(context.model),
          context_(context),
          primitive_(model_.meshes[static_cast<std::size_t>(context.mesh)]
                         .primitives[static_cast<std::size_t>(context.primitive)]),
          where_(fmt::format("{}: meshes[{}].primitives[{}]", context.source, context.mesh,
                             context.primitive)) {}

    Geometry read() {
        Geometry geometry;
        readPositions(geometry);
        if (const auto normals = attribute("NORMAL", {TINYGLTF_TYPE_VEC3}, kNormal)) {
            geometry.normal_world.resize(normals->count);
            fill(*normals, geometry.normal_world);
        }
        for (std::size_t set = 0; set < 2; ++set)
            if (const auto uv = attribute(fmt::format("TEXCOORD_{}", set), {TINYGLTF_TYPE_VEC2}, kUv)) {
                geometry.uv[set].resize(uv->count);
                fill(*uv, geometry.uv[set]);
            }
        if (const auto color = attribute("COLOR_0", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, kColor)) {
            geometry.color.assign(color->count, glm::dvec4(1.0));
            fill(*color, geometry.color);
        }
        readTriangles(geometry);
        return geometry;
    }

  private:
    [[noreturn]] void fail(const std::string& part, const std::string& why) const {
        throw InputError(fmt::format("{}.{}", where_, part), why);
    }

    void checkFormat(const std::string& name, const tinygltf::Accessor& accessor,
                     std::initializer_list<int> types, const Formats& formats) const {
        const unsigned core = accessor.normalized ? formats.normalized : formats.plain;
        const unsigned more = accessor.normalized ? formats.quantized_normalized : formats.quantized_plain;
        const unsigned found = bit(accessor.componentType);
        if (isOneOf(accessor.type, types) && ((core | (context_.quantized ? more : 0u)) & found) != 0) return;
        fail(name, fmt::format("may not have component type {}{} and {} components{}", accessor.componentType,
                               accessor.normalized ? " normalized" : "",
                               tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)),
                               (more & found) != 0 ? " without KHR_mesh_quantization" : ""));
    }

    std::optional<AccessorNumbers> attribute(const std::string& name, std::initializer_list<int> types,
                                             const Formats& formats) const {
        const auto found = primitive_.attributes.find(name);
        if (found == primitive_.attributes.end()) return std::nullopt;
        const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(found->second)];
        checkFormat("attributes." + name, accessor, types, formats);
        if (accessor.count != vertexCount(model_, primitive_))
            fail("attributes." + name, fmt::format("has {} elements, POSITION has {}", accessor.count,
                                                   vertexCount(model_, primitive_)));
        return readNumbers(model_, found->second, context_.source);
    }

    template <class Vector>
    static void fill(const AccessorNumbers& numbers, std::vector<Vector>& out) {
        for (std::size_t i = 0; i < numbers.count; ++i)
            for (int c = 0; c < numbers.components; ++c) out[i][c] = numbers.value(i, c);
    }

    void readPositions(Geometry& geometry) const {
        const AccessorNumbers positions = *attribute("POSITION", {TINYGLTF_TYPE_VEC3}, kPosition);
        geometry.position_world.resize(positions.count);
        fill(positions, geometry.position_world);
        if (positions.divisor == 1.0) geometry.world_from_file = glm::dmat4(1.0);  // the node's map follows
        geometry.position_file.resize(positions.count);
        for (std::size_t i = 0; i < positions.count; ++i)
            for (int c = 0; c < 3; ++c)
                geometry.position_file[i][c] =
                    static_cast<float>(positions.stored[3 * i + static_cast<std::size_t>(c)]);
    }

    std::vector<std::uint32_t> readIndices(std::size_t vertices) const {
        const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(primitive_.indices)];
        checkFormat("indices", accessor, {TINYGLTF_TYPE_SCALAR}, kIndices);
        const AccessorNumbers numbers = readNumbers(model_, primitive_.indices, context_.source);
        std::vector<std::uint32_t> indices(numbers.count);
        for (std::size_t i = 0; i < numbers.count; ++i) {
            if (numbers.stored[i] >= static_cast<double>(vertices))
                fail("indices", fmt::format("index {} is {}, but there are {} vertices", i, numbers.stored[i],
                                            vertices));
            indices[i] = static_cast<std::uint32_t>(numbers.stored[i]);
        }
        return indices;
    }

    void readTriangles(Geometry& geometry) const {
        const std::size_t vertices = geometry.position_world.size();
        const std::vector<std::uint32_t> indices =
            primitive_.indices < 0 ? std::vector<std::uint32_t>() : readIndices(vertices);
        const auto vertex = [&](std::size_t i) {
            return primitive_.indices < 0 ? static_cast<std::uint32_t>(i) : indices[i];
        };
        geometry.triangles.resize(primitiveSize(model_, primitive_).triangles);
        for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
            const auto corner = corners(primitive_.mode, t);
            geometry.triangles[t] = {vertex(corner[0]), vertex(corner[1]), vertex(corner[2])};
        }
    }

    const tinygltf::Model& model_;
    const PrimitiveContext& context_;
    const tinygltf::Primitive& primitive_;
    std::string where_;
};

}  // namespace

bool drawsTriangles(const tinygltf::Primitive& primitive) {
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.attributes.contains("POSITION");
}

PrimitiveSize primitiveSize(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    PrimitiveSize size;
    size.vertices = vertexCount(model, primitive);
    const std::size_t count = primitive.indices < 0
                                  ? size.vertices
                                  : model.accessors[static_cast<std::size_t>(primitive.indices)].count;
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES)
        size.triangles = count < 3 ? 0 : count - 2;
    else
        size.triangles = count / 3;
    size.left_over = primitive.mode == TINYGLTF_MODE_TRIANGLES ? count % 3 : (count < 3 ? count : 0);
    return size;
}

Geometry readPrimitive(const PrimitiveContext& context) {
    return PrimitiveReader(context).read();
}

}  // namespace edgewise
