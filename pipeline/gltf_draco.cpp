#include "pipeline/gltf_draco.h"

#include <draco/compression/decode.h>
#include <tiny_gltf.h>
#include <cstring>
#include <new>

#include "pipeline/gltf_check.h"

namespace edgewise {
namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

using Bytes = std::vector<unsigned char>;

std::unique_ptr<draco::Mesh> decodeMesh(const GltfElement& extension, const tinygltf::Model& model) {
    const tinygltf::BufferView& view =
        model.bufferViews[static_cast<std::size_t>(extension.need("bufferView").integer())];
    const Bytes& bytes = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset + view.byteLength > bytes.size())
        extension.fail("its buffer has no uri, hence no bytes");
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()) + view.byteOffset, view.byteLength);
    draco::Decoder decoder;
    try {
        auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
        if (!mesh.ok()) extension.fail("cannot be decoded: " + mesh.status().error_msg_string());
        return std::move(mesh).value();
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    extension.fail("cannot be decoded: it asks for more memory than there is");
}

/// Draco's boolean and 64-bit values have no counterpart in glTF (and any byte may stand where a boolean
/// should).
bool isGltfType(draco::DataType type) {
    return type >= draco::DT_INT8 && type <= draco::DT_FLOAT32 && type != draco::DT_INT64 &&
           type != draco::DT_UINT64;
}

template <class T>
bool appendValues(const draco::PointAttribute& attribute, std::size_t points, Bytes& bytes) {
    const int components = attribute.num_components();
    std::vector<T> value(static_cast<std::size_t>(components));
    for (std::size_t i = 0; i < points; ++i) {
        const auto mapped = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
        if (mapped.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(mapped, static_cast<std::int8_t>(components), value.data()))
            return false;
        const auto* begin = reinterpret_cast<const unsigned char*>(value.data());
        bytes.insert(bytes.end(), begin, begin + value.size() * sizeof(T));
    }
    return true;
}

bool appendValues(const draco::PointAttribute& attribute, std::size_t points, int component_type,
                  Bytes& bytes) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return appendValues<std::int8_t>(attribute, points, bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return appendValues<std::uint8_t>(attribute, points, bytes);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return appendValues<std::int16_t>(attribute, points, bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return appendValues<std::uint16_t>(attribute, points, bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return appendValues<std::uint32_t>(attribute, points, bytes);
        default:
            return appendValues<float>(attribute, points, bytes);
    }
}

/// One primitive: its decoded mesh becomes plain accessors of the model.
class Unpacker {
  public:
    Unpacker(const GltfElement& extension, tinygltf::Model& model, tinygltf::Primitive& primitive)
        : extension_(extension), model_(model), primitive_(primitive), mesh_(decodeMesh(extension, model)) {}

    void unpack() {
        const GltfElement attributes = extension_.need("attributes");
        for (const auto& [name, id] : attributes.json().items()) {
            const auto found = primitive_.attributes.find(name);
            if (found != primitive_.attributes.end())
                found->second = unpackAttribute(attributes.need(name.c_str()), found->second);
        }
        unpackIndices();
    }

  private:
    /// A copy of the accessor that reads `bytes`.
    int addAccessor(tinygltf::Accessor accessor, Bytes bytes) {
        tinygltf::BufferView view;
        view.buffer = static_cast<int>(model_.buffers.size());
        view.byteLength = bytes.size();
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.byteOffset = 0;
        accessor.sparse = {};
        model_.buffers.emplace_back().data = std::move(bytes);
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    int unpackAttribute(const GltfElement& name, int index) {
        const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
        const auto* attribute = mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(name.integer()));
        if (attribute == nullptr) name.fail("the compressed mesh has no attribute of that id");
        if (!isGltfType(attribute->data_type()))
            name.fail("the compressed mesh has it as a type that glTF lacks");
        const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
        if (attribute->num_components() != components || mesh_->num_points() != accessor.count)
            name.fail(fmt::format("has {} elements of {} components, accessors[{}] {} of {}",
                                  mesh_->num_points(), static_cast<int>(attribute->num_components()), index,
                                  accessor.count, components));
        Bytes bytes;
        if (!appendValues(*attribute, accessor.count, accessor.componentType, bytes))
            name.fail(fmt::format("its values do not fit accessors[{}]", index));
        return addAccessor(accessor, std::move(bytes));
    }

    /// Faces are a list of triangles, whatever the primitive's mode.
    void unpackIndices() {
        const std::size_t count = 3 * std::size_t(mesh_->num_faces());
        tinygltf::Accessor accessor;
        if (primitive_.indices >= 0) {
            accessor = model_.accessors[static_cast<std::size_t>(primitive_.indices)];
            if (accessor.count != count && primitive_.mode == TINYGLTF_MODE_TRIANGLES)
                extension_.fail(fmt::format("has {} indices, accessors[{}] {}", count, primitive_.indices,
                                            accessor.count));
        }
        accessor.count = count;
        accessor.type = TINYGLTF_TYPE_SCALAR;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        accessor.normalized = false;
        Bytes bytes(count * 4);
        for (std::size_t i = 0; i < count; ++i) {
            const auto face = mesh_->face(draco::FaceIndex(static_cast<std::uint32_t>(i / 3)));
            const std::uint32_t index = face[static_cast<int>(i % 3)].value();
            std::memcpy(&bytes[4 * i], &index, 4);
        }
        primitive_.indices = addAccessor(std::move(accessor), std::move(bytes));
        primitive_.mode = TINYGLTF_MODE_TRIANGLES;
    }

    GltfElement extension_;
    tinygltf::Model& model_;
    tinygltf::Primitive& primitive_;
    std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace

void checkDraco(const GltfElement& primitive, const GltfCounts& counts) {
    const auto extension = primitive.extension(kExtension);
    if (!extension) return;
    extension->need("bufferView").reference(counts.buffer_views, "buffer views");
    const GltfElement attributes = extension->need("attributes").object();
    for (const auto& [name, id] : attributes.json().items()) attributes.need(name.c_str()).integer();
    const std::uint64_t mode = primitive.integerOr("mode", 4);
    if (mode != 4 && mode != 5) extension->fail(fmt::format("may not compress a primitive of mode {}", mode));
}

void unpackDraco(const GltfElement& root, tinygltf::Model& model) {
    std::size_t mesh_index = 0;
    root.each("meshes", [&](const GltfElement& mesh) {
        std::size_t primitive_index = 0;
        mesh.each("primitives", [&](const GltfElement& primitive) {
            tinygltf::Primitive& target = model.meshes[mesh_index].primitives[primitive_index++];
            if (const auto extension = primitive.extension(kExtension))
                Unpacker(*extension, model, target).unpack();
        });
        ++mesh_index;
    });
}

}  // namespace edgewise
