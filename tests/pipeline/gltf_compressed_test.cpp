// Draco and meshopt: what the libraries' own encoders wrote comes back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/error.h"
#include "tests/pipeline/compressed_gltf.h"
#include "tests/pipeline/load_problem.h"
#include "tests/pipeline/load_scene.h"

namespace edgewise {
namespace {

using test::Corner;
using test::loadTiny;
using test::TinyGltf;
using Triangle = std::array<Corner, 3>;

/// Turned so that the least corner comes first: the winding stays.
Triangle turned(Triangle triangle) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    return triangle;
}

std::vector<Triangle> sortedTriangles(std::vector<Triangle> triangles) {
    for (Triangle& triangle : triangles) triangle = turned(triangle);
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

std::vector<Triangle> trianglesOf(const Geometry& geometry) {
    std::vector<Triangle> triangles;
    for (const auto& from : geometry.triangles) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p(geometry.position_world[from[k]]);
            triangle[k] = {p.x, p.y, p.z};
        }
        triangles.push_back(triangle);
    }
    return triangles;
}

TEST(GltfDraco, TheCubeComesBackByEitherMethod) {
    for (const bool edgebreaker : {true, false}) {
        const Scene scene = loadTiny(test::dracoGltf(edgebreaker));
        ASSERT_EQ(scene.triangle_count, 12u);
        EXPECT_EQ(sortedTriangles(trianglesOf(scene.geometry[0])), sortedTriangles(test::cubeTriangles()));
        EXPECT_TRUE(scene.ignored.empty());
        EXPECT_EQ(scene.bounds_max, glm::dvec3(1.0));
    }
}

TEST(GltfDraco, WhatDoesNotFitTheAccessorsIsRefused) {
    const std::string where = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
    const auto problem = [](const auto& spoil) {
        TinyGltf file = test::dracoGltf();
        spoil(file);
        return test::problemOf(file.asGltf());
    };
    const auto extension = [](TinyGltf& f) -> nlohmann::json& {
        return f.primitive()["extensions"]["KHR_draco_mesh_compression"];
    };
    EXPECT_EQ(problem([](TinyGltf& f) { f.root["accessors"][0]["count"] = 9; }),
              where + ".attributes.POSITION: has 8 elements of 3 components, accessors[0] 9 of 3");
    EXPECT_EQ(problem([](TinyGltf& f) { f.root["accessors"][1]["count"] = 33; }),
              where + ": has 36 indices, accessors[1] 33");
    EXPECT_EQ(problem([&](TinyGltf& f) { extension(f)["attributes"]["POSITION"] = 5; }),
              where + ".attributes.POSITION: the compressed mesh has no attribute of that id");
    EXPECT_EQ(problem([&](TinyGltf& f) { extension(f)["bufferView"] = 3; }),
              where + ".bufferView: 3 is out of range: the file has 1 buffer views");
    EXPECT_EQ(problem([](TinyGltf& f) { f.primitive()["mode"] = 1; }),
              where + ": may not compress a primitive of mode 1");
    EXPECT_TRUE(problem([](TinyGltf& f) { f.buffer[0] = 'X'; }).starts_with(where + ": cannot be decoded: "));
}

TEST(GltfDraco, DamagedBytesNeverPassUnnoticedByTheChecks) {
    const TinyGltf good = test::dracoGltf();
    int refused = 0;
    for (std::size_t at = 0; at < good.buffer.size(); ++at)
        for (const char flip : {'\x01', '\x80'}) {
            TinyGltf file = good;
            file.buffer[at] = static_cast<char>(file.buffer[at] ^ flip);
            try {
                for (const Geometry& geometry : loadTiny(file).geometry)
                    for (const auto& triangle : geometry.triangles)
                        for (const std::uint32_t v : triangle) ASSERT_LT(v, geometry.position_world.size());
            } catch (const InputError&) {
                ++refused;
            }
        }
    EXPECT_GT(refused, 20);
}

TEST(GltfMeshopt, TheSquareComesBackAsListAndStrip) {
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const Scene list = loadTiny(test::meshoptGltf()), strip = loadTiny(test::meshoptGltf(true));
    EXPECT_EQ(list.geometry[0].position_world, corners);
    EXPECT_EQ(strip.geometry[0].position_world, corners);
    // The codec may turn a triangle, never flip it.
    EXPECT_EQ(sortedTriangles(trianglesOf(list.geometry[0])),
              sortedTriangles(trianglesOf(strip.geometry[0])));
    EXPECT_EQ(strip.geometry[0].triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(GltfMeshopt, FiltersAreUndone) {
    TinyGltf file = test::meshoptGltf();
    const float h = std::sqrt(0.5f);
    const std::vector<float> normals{0, 0, 1, 0, h, 0, h, 0, 0, -1, 0, 0, h, -h, 0, 0};
    std::vector<std::int8_t> octahedral(16);
    meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
    const int view =
        test::addMeshopt(file, test::meshoptVertices(octahedral, 4), "ATTRIBUTES", 4, 4, "OCTAHEDRAL");
    file.root["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 4;
    file.root["accessors"].push_back({{"bufferView", view},
                                      {"componentType", 5120},
                                      {"normalized", true},
                                      {"count", 4},
                                      {"type", "VEC3"}});
    file.primitive()["attributes"]["NORMAL"] = 2;
    file.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    const std::vector<float> tall{0, 0, 0, 3, 0, 0, 0, 5, 0, 3, 5, 0.125f};
    std::vector<std::uint32_t> exponential(12);
    meshopt_encodeFilterExp(exponential.data(), 4, 12, 15, tall.data());
    file.root["accessors"][0]["bufferView"] =
        test::addMeshopt(file, test::meshoptVertices(exponential, 12), "ATTRIBUTES", 12, 4, "EXPONENTIAL");
    const Geometry g = loadTiny(file).geometry[0];
    for (int v = 0; v < 4; ++v)
        for (int c = 0; c < 3; ++c) {
            // Octahedral in 8 bits: steps of 1/127 in the plane; the unit vector's error is at most twice
            // that.
            EXPECT_NEAR(glm::normalize(g.normal_world[static_cast<std::size_t>(v)])[c],
                        double(normals[static_cast<std::size_t>(4 * v + c)]), 2.0 / 127);
            // One exponent a vector, 15 bits of mantissa: below 8, steps of 2^(3 - 14).
            EXPECT_NEAR(g.position_world[static_cast<std::size_t>(v)][c],
                        double(tall[static_cast<std::size_t>(3 * v + c)]), 0x1p-11);
        }
}

/// Rotations as the quaternion filter keeps them, used by instancing.
TEST(GltfMeshopt, QuaternionsAreUndone) {
    TinyGltf file = test::meshoptGltf();
    const float h = std::sqrt(0.5f);
    const std::vector<float> turns{0, 0, h, h, 0, 0, 0, 1};
    std::vector<std::int16_t> packed(8);
    meshopt_encodeFilterQuat(packed.data(), 2, 8, 16, turns.data());
    const int view =
        test::addMeshopt(file, test::meshoptVertices(packed, 8), "ATTRIBUTES", 8, 2, "QUATERNION");
    file.root["accessors"].push_back({{"bufferView", view},
                                      {"componentType", 5122},
                                      {"normalized", true},
                                      {"count", 2},
                                      {"type", "VEC4"}});
    file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = 2;
    const Scene scene = loadTiny(file);
    ASSERT_EQ(scene.geometry.size(), 2u);
    // 16-bit parts of a unit quaternion: an angle error below 2^-13.
    EXPECT_NEAR(scene.geometry[0].position_world[1].y, 1.0, 0x1p-13);
    EXPECT_NEAR(scene.geometry[1].position_world[1].x, 1.0, 0x1p-13);
}

TEST(GltfMeshopt, BadViewsAreRefused) {
    const auto problem = [](const auto& spoil) {
        TinyGltf file = test::meshoptGltf();
        spoil(file.root["bufferViews"][0],
              file.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]);
        return test::problemOf(file.asGltf());
    };
    const std::string where = "bufferViews[0].extensions.EXT_meshopt_compression";
    EXPECT_EQ(problem([](auto&, auto&) {}), "");
    EXPECT_EQ(problem([](auto&, auto& e) { e["byteStride"] = 10; }),
              where + ": byteStride 10 is not a multiple of 4 up to 256");
    EXPECT_EQ(problem([](auto&, auto& e) { e["count"] = 5; }),
              where + ": 5 times 12 bytes are not the buffer view's byteLength");
    EXPECT_EQ(problem([](auto&, auto& e) { e["mode"] = "POINTS"; }),
              where + ".mode: \"POINTS\" is not one of ATTRIBUTES, TRIANGLES, INDICES");
    EXPECT_EQ(problem([](auto&, auto& e) { e["buffer"] = 1; }), where + ": buffers[1] has no data");
    EXPECT_EQ(problem([](auto&, auto& e) { e["buffer"] = 2; }),
              where + ".buffer: 2 is out of range: the file has 2 buffers");
    EXPECT_TRUE(
        problem([](auto&, auto& e) { e["byteLength"] = 100000; }).starts_with(where + ": ends at byte"));
    EXPECT_EQ(problem([](auto&, auto& e) { e["byteLength"] = 11; }),
              where + ": byteLength 11 is too short for 4 elements");
    EXPECT_EQ(problem([](auto&, auto& e) { e["byteLength"] = 20; }), where + ": its bytes cannot be decoded");
    EXPECT_EQ(problem([](auto&, auto& e) { e["filter"] = "QUATERNION"; }),
              where + ": byteStride 12 does not fit the filter QUATERNION");
    EXPECT_EQ(problem([](auto& view, auto&) { view.erase("extensions"); }),
              "accessors[0]: its buffer has no uri, hence no bytes");
}

TEST(GltfMeshopt, PlainBytesReplaceWhatCannotBeDecoded) {
    TinyGltf file = test::meshoptGltf();
    const std::vector<float> square{0, 0, 0, 7, 0, 0, 0, 1, 0, 1, 1, 0};
    const int plain = file.view(square);
    auto& views = file.root["bufferViews"];
    views[0]["buffer"] = 0;
    views[0]["byteOffset"] = views[static_cast<std::size_t>(plain)]["byteOffset"];
    views[0]["extensions"]["EXT_meshopt_compression"]["byteLength"] = 20;
    const Scene scene = loadTiny(file);
    EXPECT_EQ(scene.geometry[0].position_world[1], glm::dvec3(7, 0, 0));
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].what,
              "compressed buffer views that cannot be decoded (their plain bytes are used)");
}

}  // namespace
}  // namespace edgewise
