// Containers and JSON text that must be refused, and files that must not be opened.
#include "pipeline/gltf_document.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>

#include "tests/pipeline/load_problem.h"
#include "tests/pipeline/tiny_gltf_file.h"

namespace edgewise {
namespace {

using test::problemOf;
using test::TempFolder;
using test::TinyGltf;

TEST(GltfDocument, ContainersAreRefusedByName) {
    const std::string good = TinyGltf().asGlb();
    const auto patched = [&](std::size_t at, std::uint32_t value) {
        std::string bytes = good;
        std::memcpy(&bytes[at], &value, 4);
        return bytes;
    };
    EXPECT_EQ(problemOf(good), "");
    EXPECT_EQ(problemOf(""), "is neither glTF nor GLB: shorter than 4 bytes");
    EXPECT_EQ(problemOf("glTF"), "GLB header: the file is shorter than 12 bytes");
    EXPECT_EQ(problemOf(patched(4, 1)), "GLB header: version 1 is not supported, only 2");
    EXPECT_TRUE(problemOf(patched(8, 7)).starts_with("GLB header: says 7 bytes"));
    EXPECT_TRUE(problemOf(patched(12, 0xfffffffc)).starts_with("GLB chunk 0: has length 4294967292"));
    EXPECT_TRUE(problemOf(patched(16, 1)).starts_with("GLB chunk 0: has type 0x00000001, not JSON"));
    EXPECT_TRUE(problemOf(test::glb("")).starts_with("GLB chunk 0: its header is cut off"));
    EXPECT_TRUE(problemOf(test::glb(test::chunk(0x4e4f534a, TinyGltf().asGltf(), ' ') + "abc"))
                    .starts_with("GLB chunk 1: its header is cut off"));
}

TEST(GltfDocument, TextThatIsNoJson) {
    EXPECT_TRUE(problemOf("{\"asset\": }").starts_with("JSON: "));
    EXPECT_TRUE(problemOf("{\"a\": \"\xff\"}").starts_with("JSON: "));
    EXPECT_TRUE(problemOf("{\"a\": 1e999}").starts_with("JSON: "));
    EXPECT_EQ(problemOf(std::string(1000, '\0')),
              "is neither glTF nor GLB: it starts with neither { nor glTF");
    EXPECT_EQ(problemOf("[1, 2]"), "JSON: the file's root is not an object");
    EXPECT_EQ(problemOf(std::string(10'000'000, '[')), "JSON: is nested deeper than 256 levels");
    EXPECT_EQ(jsonDepth(R"({"a": ["[[[", "\"[[", {}]})", 100), 3);
}

TEST(GltfDocument, EveryTruncationOfAGlbIsRefused) {
    const std::string good = TinyGltf().asGlb();
    for (std::size_t length = 0; length < good.size(); ++length)
        EXPECT_NE(problemOf(good.substr(0, length)), "") << length;
}

TEST(GltfDocument, OddFilesNeitherHangNorEscape) {
    const TempFolder folder, outside;
    EXPECT_THROW(loadGltf(folder / "absent.glb"), InputError);
    EXPECT_THROW(loadGltf(folder / ""), InputError);
    EXPECT_THROW(loadGltf("/dev/zero"), InputError);
    std::filesystem::create_symlink("/dev/zero", folder / "zeros.bin");
    ASSERT_EQ(::mkfifo((folder / "pipe.bin").c_str(), 0600), 0);
    test::writeFile(outside / "secret.bin", std::string(36, '\0'));
    std::filesystem::create_symlink(outside / "secret.bin", folder / "link.bin");
    for (const char* uri : {"pipe.bin", "link.bin", "zeros.bin", "/dev/zero", ".", "a\nb"}) {
        TinyGltf file;
        file.root["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        test::writeFile(folder / "a.gltf", file.asGltf());
        EXPECT_THROW(loadGltf(folder / "a.gltf"), InputError) << uri;
    }
}

/// Named like anything, in folders below the scene's, with dots that stay inside.
TEST(GltfDocument, UrisMayWanderInsideTheFolder) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "sub");
    TinyGltf file;
    test::writeFile(folder / "sub/Ä b.BIN", file.buffer);
    for (const char* uri : {"sub/%C3%84%20b.BIN", "./sub/%c3%84 b.BIN", "sub/../sub/Ä b.BIN"}) {
        file.root["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        test::writeFile(folder / "a.gltf", file.asGltf());
        EXPECT_EQ(loadGltf(folder / "a.gltf").triangle_count, 1u) << uri;
    }
}

TEST(GltfDocument, LimitsAreFailuresNotInputErrors) {
    const auto load = [](const TinyGltf& file) {
        const TempFolder folder;
        test::writeFile(folder / "a.gltf", file.asGltf());
        loadGltf(folder / "a.gltf");
    };
    TinyGltf zeros;
    zeros.root["accessors"][0]["count"] = 4'000'000'000u;
    zeros.root["accessors"][0].erase("bufferView");
    EXPECT_THROW(load(zeros), FailureError);
    TinyGltf repeated;
    repeated.root["accessors"][0]["count"] = 1'000'000;
    repeated.root["accessors"][0].erase("bufferView");
    repeated.root["meshes"][0]["primitives"] = std::vector<nlohmann::json>(1000, repeated.primitive());
    EXPECT_THROW(load(repeated), FailureError);
    TinyGltf instanced;
    instanced.root["accessors"].push_back(
        {{"componentType", 5126}, {"count", 4'000'000'000u}, {"type", "VEC3"}});
    instanced.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = 1;
    EXPECT_THROW(load(instanced), FailureError);
}

}  // namespace
}  // namespace edgewise
