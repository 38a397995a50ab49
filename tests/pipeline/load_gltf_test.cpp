// What a legal file becomes: hierarchy, geometry, cameras, order.
#include "pipeline/load_gltf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/error.h"
#include "tests/pipeline/tiny_gltf_file.h"

namespace edgewise {
namespace {

using nlohmann::json;
using test::TempFolder;
using test::TinyGltf;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Scene load(const TinyGltf& file, const LoadOptions& options = {}) {
    const TempFolder folder;
    test::writeFile(folder / "a.gltf", file.asGltf());
    return loadGltf(folder / "a.gltf", options);
}

TEST(LoadGltf, AllContainersGiveTheSameScene) {
    const TempFolder folder;
    TinyGltf file;
    test::writeFile(folder / "a.glb", file.asGlb());
    test::writeFile(folder / "b.gltf", file.asGltf());
    test::writeFile(folder / "long +name.bin", file.buffer + "more bytes than byteLength");
    file.root["buffers"] = {{{"byteLength", 36.0}, {"uri", "long%20+name.bin"}}};
    test::writeFile(folder / "c.gltf", file.asGltf());
    for (const char* name : {"a.glb", "b.gltf", "c.gltf"}) {
        const Scene scene = loadGltf(folder / name);
        ASSERT_EQ(scene.triangle_count, 1u) << name;
        EXPECT_EQ(scene.geometry[0].position_world[1], glm::dvec3(1, 0, 0));
        EXPECT_EQ(scene.geometry[0].triangles, (Triangles{{0, 1, 2}}));
        EXPECT_EQ(scene.bounds_max, glm::dvec3(1, 1, 0));
        EXPECT_TRUE(scene.ignored.empty());
    }
}

TEST(LoadGltf, ChunksOfExtensionsAreSkipped) {
    const TempFolder folder;
    std::string bytes = TinyGltf().asGlb() + test::chunk(0x12345678, "later", 0);
    const auto size = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(&bytes[8], &size, 4);
    test::writeFile(folder / "a.glb", bytes);
    EXPECT_EQ(loadGltf(folder / "a.glb").triangle_count, 1u);
}

TEST(LoadGltf, HierarchyComposes) {
    TinyGltf file;
    // Parent: a quarter turn about z, then 10 along x; child: scale by (2, 3, 4), then 1 along y. All exact.
    file.root["nodes"] = {{{"children", {1}}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}},
                          {{"mesh", 0}, {"scale", {2, 3, 4}}, {"translation", {0, 1, 0}}, {"name", "child"}}};
    const Scene scene = load(file);
    EXPECT_EQ(scene.geometry[0].position_world[0], glm::dvec3(9, 0, 0));
    EXPECT_EQ(scene.geometry[0].position_world[1], glm::dvec3(9, 2, 0));
    EXPECT_EQ(scene.geometry[0].position_world[2], glm::dvec3(6, 0, 0));
    EXPECT_EQ(scene.geometry[0].position_file[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.geometry[0].node, 1u);
    EXPECT_EQ(scene.node_names[1], "child");
}

TEST(LoadGltf, QuaternionsAreNormalised) {
    TinyGltf file;
    file.root["nodes"][0]["rotation"] = {0, 0, 1e200, 1e200};  // a quarter turn about z
    const Scene scene = load(file);
    // Ten roundings of numbers below 2: the quaternion's parts (3), the matrix' (4), the product's (3).
    EXPECT_NEAR(scene.geometry[0].position_world[1].x, 0.0, 20 * 0x1p-53);
    EXPECT_NEAR(scene.geometry[0].position_world[1].y, 1.0, 20 * 0x1p-53);
}

TEST(LoadGltf, MirroringFlipsWindingAndKeepsNormalsOutside) {
    for (const double sign : {1.0, -1.0})
        for (const double size : {1.0, 1e-120, 1e120}) {
            TinyGltf file;
            file.primitive()["attributes"]["NORMAL"] =
                file.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
            file.root["nodes"][0]["scale"] = {sign * size, size, size};
            const Scene scene = load(file);
            const Geometry& geometry = scene.geometry[0];
            EXPECT_EQ(geometry.triangles[0][1], sign > 0 ? 1u : 2u);
            EXPECT_GT(geometry.normal_world[0].z, 0.0);
            const auto p = [&](int corner) {
                return geometry.position_world[geometry.triangles[0][corner]] / size;
            };
            EXPECT_GT(glm::dot(glm::cross(p(1) - p(0), p(2) - p(0)), geometry.normal_world[0]), 0.0);
        }
}

TEST(LoadGltf, NormalsFollowTheInverseTranspose) {
    TinyGltf file;
    file.primitive()["attributes"]["NORMAL"] = file.accessor<float>("VEC3", {1, 1, 0, 1, 1, 0, 1, 1, 0});
    file.root["nodes"][0]["scale"] = {4, 1, 1};
    const glm::dvec3 normal = load(file).geometry[0].normal_world[0];
    EXPECT_EQ(normal.x * 4.0, normal.y);  // (1/4, 1, 0) up to a power of two
    EXPECT_EQ(normal.z, 0.0);
}

TEST(LoadGltf, ModesAndTheirDegenerateTrianglesAllCount) {
    const std::vector<std::uint8_t> indices{0, 1, 2, 2, 1, 0, 0};
    const auto triangles = [&](int mode) {
        TinyGltf file;
        file.primitive()["indices"] = file.accessor<std::uint8_t>("SCALAR", indices);
        file.primitive()["mode"] = mode;
        return load(file);
    };
    EXPECT_EQ(triangles(5).geometry[0].triangles,
              (Triangles{{0, 1, 2}, {1, 2, 2}, {2, 2, 1}, {2, 0, 1}, {1, 0, 0}}));
    EXPECT_EQ(triangles(6).geometry[0].triangles,
              (Triangles{{1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 0, 0}, {0, 0, 0}}));
    const Scene list = triangles(4);
    EXPECT_EQ(list.geometry[0].triangles, (Triangles{{0, 1, 2}, {2, 1, 0}}));
    ASSERT_EQ(list.ignored.size(), 1u);
    EXPECT_EQ(list.ignored[0].what, "vertices of incomplete triangles");
    EXPECT_EQ(list.ignored[0].count, 1u);
    for (const int mode : {0, 1, 2, 3}) {
        const Scene none = triangles(mode);
        EXPECT_EQ(none.triangle_count, 0u);
        ASSERT_EQ(none.ignored.size(), 1u);
        EXPECT_EQ(none.ignored[0].what, mode == 0 ? "point primitives" : "line primitives");
    }
}

TEST(LoadGltf, TheIndexIsDepthFirst) {
    TinyGltf file;
    // 0 -> (1 -> 3, 2), 4: depth-first 0 1 3 2 4. Mesh 1 has two primitives of one triangle each.
    file.root["meshes"].push_back({{"primitives", {file.primitive(), file.primitive()}}});
    file.root["nodes"] = {{{"children", {1, 2}}},
                          {{"mesh", 0}, {"children", {3}}},
                          {{"mesh", 0}},
                          {{"mesh", 1}},
                          {{"mesh", 1}}};
    file.root["scenes"][0]["nodes"] = {0, 4};
    const Scene scene = load(file);
    std::vector<std::array<std::uint32_t, 3>> order;
    for (const Geometry& geometry : scene.geometry)
        order.push_back({geometry.node, geometry.primitive, geometry.first_triangle});
    EXPECT_EQ(order, (Triangles{{1, 0, 0}, {3, 0, 1}, {3, 1, 2}, {2, 0, 3}, {4, 0, 4}, {4, 1, 5}}));
    EXPECT_EQ(scene.triangle_count, 6u);
}

TEST(LoadGltf, DeepAndWideHierarchies) {
    constexpr int kNodes = 100'000;
    for (const bool deep : {true, false}) {
        TinyGltf file;
        json nodes = json::array();
        for (int i = 0; i + 1 < kNodes; ++i) nodes.push_back({{"translation", {1, 0, 0}}});
        nodes.push_back({{"mesh", 0}});
        json all = json::array();
        for (int i = 1; i < kNodes; ++i) all.push_back(i);
        if (!deep)
            nodes[0]["children"] = all;
        else
            for (int i = 0; i + 1 < kNodes; ++i) nodes[static_cast<std::size_t>(i)]["children"] = {i + 1};
        file.root["nodes"] = nodes;
        const Scene scene = load(file);
        ASSERT_EQ(scene.geometry.size(), 1u);
        EXPECT_EQ(scene.geometry[0].position_world[0].x, deep ? kNodes - 1.0 : 1.0);
    }
}

TEST(LoadGltf, ScenesAreChosenByNameThenIndex) {
    TinyGltf file;
    file.root["nodes"] = {{{"mesh", 0}}, {{"children", {0}}, {"translation", {5, 0, 0}}}};
    file.root["scenes"] = {
        {{"nodes", {1}}, {"name", "1"}}, {{"nodes", json::array()}}, {{"name", "alone"}, {"nodes", {0}}}};
    const auto x_of = [&](const std::string& wanted) {
        LoadOptions options;
        options.scene = wanted;
        const Scene scene = load(file, options);
        return scene.geometry.empty() ? -1.0 : scene.geometry[0].position_world[0].x;
    };
    EXPECT_EQ(x_of(""), 5.0);
    EXPECT_EQ(x_of("1"), 5.0) << "the name 1 wins over the index 1";
    EXPECT_EQ(x_of("alone"), 0.0) << "a parent outside the scene does not move it";
    EXPECT_EQ(x_of("2"), 0.0);
    EXPECT_THROW(x_of("3"), InputError);
    EXPECT_THROW(x_of("-1"), InputError);
    file.root.erase("scene");
    EXPECT_EQ(x_of(""), 5.0);
    file.root.erase("scenes");
    EXPECT_EQ(x_of(""), 5.0) << "without scenes every root is drawn";
    EXPECT_THROW(x_of("0"), InputError);
}

TEST(LoadGltf, EmptyFilesAreEmptyScenes) {
    TinyGltf file;
    file.root = {{"asset", {{"version", "2.0"}}}};
    const Scene scene = load(file);
    EXPECT_EQ(scene.triangle_count, 0u);
    EXPECT_EQ(scene.bounds_min, glm::dvec3(0.0));
    EXPECT_EQ(scene.bounds_max, glm::dvec3(0.0));
}

TEST(LoadGltf, CamerasAreRigidAndInDepthFirstOrder) {
    TinyGltf file;
    file.root["cameras"] = {{{"type", "orthographic"},
                             {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}},
                             {"name", "flat"}},
                            {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}}};
    file.root["nodes"] = {{{"children", {1, 2}}, {"scale", {-2, 3, 4}}},
                          {{"camera", 1}, {"name", "eye"}, {"translation", {1, 1, 1}}},
                          {{"camera", 0}, {"rotation", {0, 1, 0, 0}}}};
    const Scene scene = load(file);
    ASSERT_EQ(scene.cameras.size(), 2u);
    const Camera &eye = scene.cameras[0], &flat = scene.cameras[1];
    EXPECT_EQ(eye.name, "eye");
    EXPECT_TRUE(eye.perspective);
    EXPECT_EQ(eye.yfov, 0.5);
    EXPECT_FALSE(eye.zfar || eye.aspect);
    EXPECT_EQ(eye.world_from_camera, glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 3, 4, 1));
    EXPECT_EQ(flat.name, "flat");
    EXPECT_FALSE(flat.perspective);
    EXPECT_EQ(flat.ymag, 2.0);
    EXPECT_EQ(flat.zfar, 9.0);
    EXPECT_EQ(flat.world_from_camera, glm::dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1));
}

TEST(LoadGltf, WhatIsIgnoredIsListedOnceWithACount) {
    TinyGltf file;
    file.root["materials"] = {
        {{"alphaMode", "BLEND"}, {"extensions", {{"KHR_materials_clearcoat", json::object()}}}},
        {{"alphaMode", "BLEND"}, {"emissiveFactor", {0, 0, 1}}},
        {{"alphaMode", "MASK"},
         {"emissiveFactor", {0, 0, 0}},
         {"extensions", {{"KHR_materials_unlit", json::object()}}}}};
    file.root["materials"][1]["alphaMode"] = "GLASS";
    file.root["meshes"].push_back({{"primitives", {{{"mode", 9}, {"attributes", {{"POSITION", 0}}}}}}});
    file.primitive()["targets"] = {{{"POSITION", 0}}, {{"COLOR_0", 0}}, {{"TEXCOORD_1", 0}}};
    file.root["extensionsUsed"] = {"KHR_materials_clearcoat", "EXT_never_used"};
    std::vector<std::pair<std::string, std::size_t>> found;
    for (const Ignored& entry : load(file).ignored) found.emplace_back(entry.what, entry.count);
    EXPECT_EQ(found, (std::vector<std::pair<std::string, std::size_t>>{
                         {"unknown alpha modes", 1},
                         {"primitives whose morph targets change texture coordinates or colours", 1},
                         {"primitives of an unknown mode", 1},
                         {"extension KHR_materials_clearcoat", 1}}));
}

TEST(LoadGltf, ProgressRisesToOneAndMayStop) {
    std::vector<double> seen;
    LoadOptions options;
    options.progress = [&](double fraction) { seen.push_back(fraction); };
    load(TinyGltf(), options);
    ASSERT_FALSE(seen.empty());
    EXPECT_EQ(seen.back(), 1.0);
    options.progress = [](double) { throw Interrupted(); };
    EXPECT_THROW(load(TinyGltf(), options), Interrupted);
}

TEST(LoadGltf, TheEngine) {
    const std::filesystem::path path =
        "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "assimp-testmodels is not installed";
    const Scene scene = loadGltf(path);
    EXPECT_EQ(scene.triangle_count, 121496u);
    EXPECT_EQ(scene.node_names.size(), 82u);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(scene.ignored.empty());
}

}  // namespace
}  // namespace edgewise
