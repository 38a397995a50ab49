// Files whose geometry is compressed by the libraries' own encoders.
#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <array>
#include <stdexcept>

#include "tests/pipeline/tiny_gltf_file.h"

namespace edgewise::test {

using Corner = std::array<float, 3>;

/// The cube [0, 1]^3 as 12 triangles, counter-clockwise from outside.
inline std::vector<std::array<Corner, 3>> cubeTriangles() {
    std::vector<std::array<Corner, 3>> triangles;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const auto corner = [&](int u, int v) {
                Corner p{};
                p[static_cast<std::size_t>(axis)] = static_cast<float>(side);
                p[static_cast<std::size_t>((axis + 1) % 3)] = static_cast<float>(side != 0 ? u : v);
                p[static_cast<std::size_t>((axis + 2) % 3)] = static_cast<float>(side != 0 ? v : u);
                return p;
            };
            triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
            triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
        }
    return triangles;
}

/// The cube by KHR_draco_mesh_compression, positions unquantized: exact. `edgebreaker`: that method, else the
/// sequential one.
inline TinyGltf dracoGltf(bool edgebreaker = true) {
    draco::TriangleSoupMeshBuilder builder;
    const auto cube = cubeTriangles();
    builder.Start(static_cast<int>(cube.size()));
    const int attribute = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::size_t i = 0; i < cube.size(); ++i)
        builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(static_cast<std::uint32_t>(i)),
                                          cube[i][0].data(), cube[i][1].data(), cube[i][2].data());
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                          : draco::MESH_SEQUENTIAL_ENCODING);
    draco::EncoderBuffer encoded;
    if (!mesh || !encoder.EncodeMeshToBuffer(*mesh, &encoded).ok())
        throw std::runtime_error("draco does not encode the cube");
    TinyGltf file;
    file.root["accessors"] = {{{"componentType", 5126}, {"count", mesh->num_points()}, {"type", "VEC3"}},
                              {{"componentType", 5123}, {"count", 36}, {"type", "SCALAR"}}};
    file.root["bufferViews"] = nlohmann::json::array();
    file.buffer.clear();
    const int view = file.view(std::string(encoded.data(), encoded.size()));
    file.primitive()["indices"] = 1;
    file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", mesh->attribute(attribute)->unique_id()}}}};
    file.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

/// Adds a compressed view of `count` elements of `stride` bytes over the placeholder; gives its index.
inline int addMeshopt(TinyGltf& file, const std::string& bytes, const char* mode, std::size_t stride,
                      std::size_t count, const char* filter = "NONE") {
    const int view = file.view(bytes);
    nlohmann::json& made = file.root["bufferViews"][static_cast<std::size_t>(view)];
    made["extensions"]["EXT_meshopt_compression"] = made;
    nlohmann::json& extension = made["extensions"]["EXT_meshopt_compression"];
    extension.update({{"byteStride", stride}, {"count", count}, {"mode", mode}, {"filter", filter}});
    made["buffer"] = 1;
    made["byteOffset"] = file.placeholder_bytes;
    made["byteLength"] = stride * count;
    file.placeholder_bytes += stride * count;
    return view;
}

template <class T>
std::string meshoptVertices(const std::vector<T>& numbers, std::size_t stride) {
    const std::size_t count = numbers.size() * sizeof(T) / stride;
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                            numbers.data(), count, stride));
    return bytes;
}

inline std::string meshoptTriangles(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                           indices.data(), indices.size()));
    return bytes;
}

/// A square of two triangles by EXT_meshopt_compression: positions as attributes, indices as triangles, or,
/// for a strip, as a sequence. Corners (0,0,0), (1,0,0), (0,1,0), (1,1,0).
inline TinyGltf meshoptGltf(bool strip = false) {
    TinyGltf file;
    file.root["bufferViews"] = nlohmann::json::array();
    file.buffer.clear();
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const int positions = addMeshopt(file, meshoptVertices(square, 12), "ATTRIBUTES", 12, 4);
    int indices = 0;
    if (strip) {
        const std::vector<std::uint32_t> order{0, 1, 2, 3};
        std::string bytes(meshopt_encodeIndexSequenceBound(4, 4), '\0');
        bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                                 order.data(), order.size()));
        indices = addMeshopt(file, bytes, "INDICES", 4, 4);
        file.primitive()["mode"] = 5;
    } else {
        indices = addMeshopt(file, meshoptTriangles({0, 1, 2, 2, 1, 3}, 4), "TRIANGLES", 2, 6);
    }
    file.root["accessors"] = {
        {{"bufferView", positions}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"bufferView", indices},
         {"componentType", strip ? 5125 : 5123},
         {"count", strip ? 4 : 6},
         {"type", "SCALAR"}}};
    file.primitive()["indices"] = 1;
    file.root["extensionsRequired"] = {"EXT_meshopt_compression"};
    return file;
}

}  // namespace edgewise::test
