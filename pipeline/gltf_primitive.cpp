#include "pipeline/gltf_primitive.h"

#include <fmt/format.h>
#include <tiny_gltf.h>
#include <cmath>

#include "pipeline/error.h"
#include "pipeline/gltf_accessor.h"
#include "pipeline/gltf_attribute.h"
#include "pipeline/gltf_morph.h"

namespace edgewise {
namespace {

constexpr unsigned kSmall = kByteBit | kUbyteBit | kShortBit | kUshortBit;
constexpr AttributeFormats kPosition{kFloatBit, 0, kSmall, kSmall};
constexpr AttributeFormats kDirection{kFloatBit, 0, 0, kByteBit | kShortBit};
constexpr AttributeFormats kUv{kFloatBit, kUbyteBit | kUshortBit, kSmall, kByteBit | kShortBit};
constexpr AttributeFormats kColor{kFloatBit, kUbyteBit | kUshortBit, 0, 0};
constexpr AttributeFormats kJoints{kUbyteBit | kUshortBit, 0, 0, 0};
constexpr AttributeFormats kWeights{kFloatBit, kUbyteBit | kUshortBit, 0, 0};
constexpr AttributeFormats kIndices{kUbyteBit | kUshortBit | kUintBit, 0, 0, 0};

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
        : context_(context),
          model_(context.model),
          primitive_(model_.meshes[static_cast<std::size_t>(context.mesh)]
                         .primitives[static_cast<std::size_t>(context.primitive)]),
          reader_(
              model_, context.source,
              fmt::format("{}: meshes[{}].primitives[{}]", context.source, context.mesh, context.primitive),
              vertexCount(model_, primitive_), context.quantized) {}

    LocalPrimitive read() const {
        LocalPrimitive made;
        Geometry& geometry = made.geometry;
        readPositions(geometry);
        readDirections(geometry);
        for (std::size_t set = 0; set < 2; ++set)
            if (const auto uv = attribute(fmt::format("TEXCOORD_{}", set), {TINYGLTF_TYPE_VEC2}, kUv))
                fill(*uv, geometry.uv[set]);
        if (const auto color = attribute("COLOR_0", {TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4}, kColor)) {
            geometry.color.assign(color->count, glm::dvec4(1.0));
            fill(*color, geometry.color);
        }
        readTriangles(geometry);
        readInfluences(made.influences);
        if (addMorphTargets(primitive_, reader_, context_.morph_weights, geometry))
            adoptPositions(geometry, reader_.where());
        return made;
    }

  private:
    std::optional<AccessorNumbers> attribute(const std::string& name, std::initializer_list<int> types,
                                             const AttributeFormats& formats) const {
        return reader_.read(primitive_.attributes, "attributes", name, types, formats);
    }

    template <class Vector>
    static void fill(const AccessorNumbers& numbers, std::vector<Vector>& out) {
        out.resize(numbers.count);
        for (std::size_t i = 0; i < numbers.count; ++i)
            for (int c = 0; c < numbers.components; ++c) out[i][c] = numbers.value(i, c);
    }

    void readPositions(Geometry& geometry) const {
        const AccessorNumbers positions = *attribute("POSITION", {TINYGLTF_TYPE_VEC3}, kPosition);
        fill(positions, geometry.position_world);
        if (positions.divisor == 1.0) geometry.world_from_file = glm::dmat4(1.0);  // the node's map follows
        geometry.position_file.resize(positions.count);
        for (std::size_t i = 0; i < positions.count; ++i)
            for (int c = 0; c < 3; ++c)
                geometry.position_file[i][c] =
                    static_cast<float>(positions.stored[3 * i + static_cast<std::size_t>(c)]);
    }

    /// Tangents belong to normals: flat ones come with tangents of their own.
    void readDirections(Geometry& geometry) const {
        const auto normals = attribute("NORMAL", {TINYGLTF_TYPE_VEC3}, kDirection);
        if (!normals) return;
        fill(*normals, geometry.normal_world);
        if (const auto tangents = attribute("TANGENT", {TINYGLTF_TYPE_VEC4}, kDirection))
            fill(*tangents, geometry.tangent_world);
    }

    std::vector<std::uint32_t> readIndices(std::size_t vertices) const {
        const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(primitive_.indices)];
        reader_.checkFormat("indices", accessor, {TINYGLTF_TYPE_SCALAR}, kIndices);
        const AccessorNumbers numbers = readNumbers(model_, primitive_.indices, context_.source);
        std::vector<std::uint32_t> indices(numbers.count);
        for (std::size_t i = 0; i < numbers.count; ++i) {
            if (numbers.stored[i] >= static_cast<double>(vertices))
                reader_.fail("indices", fmt::format("index {} is {}, but there are {} vertices", i,
                                                    numbers.stored[i], vertices));
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

    /// As many sets as there are from JOINTS_0 and WEIGHTS_0 on, both of each.
    void readInfluences(SkinInfluences& influences) const {
        std::vector<std::pair<AccessorNumbers, AccessorNumbers>> sets;
        for (;;) {
            const std::string weights_name = fmt::format("WEIGHTS_{}", sets.size());
            auto joints = attribute(fmt::format("JOINTS_{}", sets.size()), {TINYGLTF_TYPE_VEC4}, kJoints);
            auto weights = attribute(weights_name, {TINYGLTF_TYPE_VEC4}, kWeights);
            if (!joints || !weights) break;
            for (std::size_t i = 0; i < weights->stored.size(); ++i)
                if (weights->stored[i] < 0.0)
                    reader_.fail("attributes." + weights_name,
                                 fmt::format("vertex {} has the weight {}", i / 4, weights->stored[i]));
            sets.emplace_back(std::move(*joints), std::move(*weights));
        }
        influences.per_vertex = 4 * sets.size();
        for (std::size_t v = 0; !sets.empty() && v < sets[0].first.count; ++v)
            for (const auto& [joints, weights] : sets)
                for (int c = 0; c < 4; ++c)
                    influences.entries.push_back(
                        {static_cast<std::uint32_t>(joints.value(v, c)), weights.value(v, c)});
    }

    const PrimitiveContext& context_;
    const tinygltf::Model& model_;
    const tinygltf::Primitive& primitive_;
    AttributeReader reader_;
};

}  // namespace

bool drawsTriangles(const tinygltf::Primitive& primitive) {
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN &&
           primitive.attributes.contains("POSITION");
}

PrimitiveSize primitiveSize(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    PrimitiveSize size;
    size.vertices = vertexCount(model, primitive);
    const auto positions = static_cast<std::size_t>(primitive.attributes.at("POSITION"));
    size.has_bytes = model.accessors[positions].bufferView >= 0;
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

LocalPrimitive readPrimitive(const PrimitiveContext& context) {
    return PrimitiveReader(context).read();
}

/// In two passes: where both conversions meet in one, GCC 12 leaves the rounding out (at -O2, vectorised).
void adoptPositions(Geometry& geometry, const std::string& where) {
    for (std::size_t i = 0; i < geometry.position_world.size(); ++i) {
        const glm::vec3 rounded(geometry.position_world[i]);
        if (!(std::isfinite(rounded.x) && std::isfinite(rounded.y) && std::isfinite(rounded.z)))
            throw InputError(where, fmt::format("vertex {} is moved out of float32's range", i));
        geometry.position_file[i] = rounded;
    }
    for (std::size_t i = 0; i < geometry.position_world.size(); ++i)
        geometry.position_world[i] = glm::dvec3(geometry.position_file[i]);
    geometry.world_from_file = glm::dmat4(1.0);
}

}  // namespace edgewise
