// Materials: every factor and slot, colour encodings, texture transforms, WebP.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/decode_image.h"
#include "pipeline/error.h"
#include "pipeline/srgb.h"
#include "tests/pipeline/feature_gltf.h"
#include "tests/pipeline/load_scene.h"

namespace edgewise {
namespace {

using nlohmann::json;
using test::loadTiny;
using test::TinyGltf;

glm::vec4 firstTexel(const Scene& scene, const TextureUse& use) {
    return scene.images[scene.textures[use.texture].image].texels[0];
}

TEST(GltfMaterial, FactorsAreRead) {
    const Material material = loadTiny(test::texturedGltf()).materials[0];
    EXPECT_EQ(material.metallic, 0.25);
    EXPECT_EQ(material.roughness, 0.75);
    EXPECT_EQ(material.normal_scale, 0.5);
    EXPECT_EQ(material.occlusion_strength, 0.125);
    EXPECT_EQ(material.emissive, glm::dvec3(8, 4, 0)) << "the factor times KHR_materials_emissive_strength";
    const Material fallback = loadTiny(test::texturedGltf()).materials[1];
    EXPECT_EQ(fallback.metallic, 1.0);
    EXPECT_EQ(fallback.roughness, 1.0);
    EXPECT_EQ(fallback.emissive, glm::dvec3(0));
}

TEST(GltfMaterial, OnePictureIsDecodedOnceForEachEncoding) {
    const Scene scene = loadTiny(test::texturedGltf());
    const Material& m = scene.materials[0];
    EXPECT_EQ(scene.images.size(), 4u) << "two pictures, each as colours and as numbers";
    EXPECT_EQ(m.normal_map.texture, m.occlusion_map.texture);
    const auto linear = [](int byte) { return static_cast<float>(decodeSrgb(byte / 255.0)); };
    const auto plain = [](int byte) { return static_cast<float>(byte / 255.0); };
    EXPECT_EQ(firstTexel(scene, m.base_color_map), glm::vec4(linear(0x80), linear(0x40), 1, 1));
    EXPECT_EQ(firstTexel(scene, m.metallic_roughness_map), glm::vec4(plain(0x80), plain(0x40), 1, 1));
    EXPECT_EQ(firstTexel(scene, m.normal_map), glm::vec4(plain(0x80), plain(0x40), plain(0x20), 1));
    EXPECT_EQ(firstTexel(scene, m.emissive_map), glm::vec4(linear(0x80), linear(0x40), linear(0x20), 1));
}

TEST(GltfMaterial, UnlitOnesShowTheirBaseColourAlone) {
    TinyGltf file = test::texturedGltf();
    file.root["materials"][0]["extensions"]["KHR_materials_unlit"] = json::object();
    const Scene scene = loadTiny(file);
    EXPECT_TRUE(scene.materials[0].base_color_map.present());
    EXPECT_FALSE(scene.materials[0].normal_map.present() || scene.materials[0].emissive_map.present());
    EXPECT_EQ(scene.images.size(), 1u);
}

/// The extension's own example: the lower left quadrant of the image, turned clockwise by a right angle.
TEST(GltfMaterial, TextureTransformsTakeTheLowerLeftQuadrant) {
    const TextureUse use = loadTiny(test::texturedGltf()).materials[0].normal_map;
    EXPECT_EQ(use.uv, 1) << "the extension's texCoord wins";
    const auto at = [&](double u, double v) { return glm::dvec2(use.uv_from_vertex * glm::dvec3(u, v, 1)); };
    // cos(pi/2) as rounded is 6.1e-17; two roundings of numbers below 1 more.
    constexpr double kRoundings = 3 * 0x1p-53;
    const auto expectNear = [&](glm::dvec2 found, glm::dvec2 wanted) {
        EXPECT_NEAR(found.x, wanted.x, kRoundings);
        EXPECT_NEAR(found.y, wanted.y, kRoundings);
    };
    expectNear(at(0, 0), {0, 1});
    expectNear(at(1, 0), {0, 0.5});
    expectNear(at(0, 1), {0.5, 1});
    expectNear(at(1, 1), {0.5, 0.5});
    EXPECT_EQ(loadTiny(test::texturedGltf()).materials[0].base_color_map.uv_from_vertex, glm::dmat3(1.0));
}

TEST(GltfMaterial, TransformsScaleThenTurnThenMove) {
    TinyGltf file = test::texturedGltf();
    file.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
             ["KHR_texture_transform"] = {{"offset", {5, 7}}, {"rotation", 0.5}, {"scale", {2, 3}}};
    const TextureUse use = loadTiny(file).materials[0].base_color_map;
    const glm::dvec2 found(use.uv_from_vertex * glm::dvec3(0.25, 0.5, 1));
    const double u = 2 * 0.25, v = 3 * 0.5, c = std::cos(0.5), s = std::sin(0.5);
    EXPECT_NEAR(found.x, c * u + s * v + 5, 8 * 0x1p-52);
    EXPECT_NEAR(found.y, c * v - s * u + 7, 8 * 0x1p-52);
    EXPECT_EQ(use.uv, 0);
}

TEST(GltfMaterial, Ktx2GivesWayToItsFallback) {
    TinyGltf file = test::texturedGltf();
    file.root["images"].push_back({{"uri", "never-opened.ktx2"}, {"mimeType", "image/ktx2"}});
    file.root["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 2;
    file.root["textures"].push_back({{"extensions", {{"KHR_texture_basisu", {{"source", 2}}}}}});
    file.root["materials"][0]["emissiveTexture"]["index"] = 2;
    file.root["extensionsUsed"] = {"KHR_texture_basisu"};
    const Scene scene = loadTiny(file);
    EXPECT_TRUE(scene.materials[0].base_color_map.present());
    EXPECT_FALSE(scene.materials[0].emissive_map.present());
    ASSERT_EQ(scene.ignored.size(), 2u);
    EXPECT_EQ(scene.ignored[0].what, "extension KHR_texture_basisu");
    EXPECT_EQ(scene.ignored[0].count, 2u);
    EXPECT_EQ(scene.ignored[1].what, "textures without an image of a known format");
    file.root["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_THROW(loadTiny(file), InputError);
}

TEST(GltfMaterial, PicturesOfOtherFormatsAreLeftOut) {
    TinyGltf file = test::texturedGltf();
    file.root["images"][1]["bufferView"] = file.view("GIF89a, whatever follows");
    const Scene scene = loadTiny(file);
    EXPECT_FALSE(scene.materials[0].normal_map.present());
    EXPECT_TRUE(scene.materials[0].base_color_map.present());
    ASSERT_EQ(scene.ignored.size(), 1u);
    EXPECT_EQ(scene.ignored[0].what, "textures without an image of a known format");
    EXPECT_EQ(scene.ignored[0].count, 3u);
}

TEST(GltfMaterial, TangentsFollowTheirNode) {
    TinyGltf file = test::texturedGltf();
    file.root["nodes"][0]["scale"] = {-2, 1, 1};
    const Geometry geometry = loadTiny(file).geometry[0];
    // The surface's bitangent is (0, 1, 0) * sign in the mesh, and stays so; the mirrored frame has the other
    // sign.
    ASSERT_EQ(geometry.tangent_world.size(), 3u);
    EXPECT_LT(geometry.tangent_world[0].x, 0.0);
    EXPECT_EQ(geometry.tangent_world[0].y, 0.0);
    EXPECT_EQ(geometry.tangent_world[0].z, 0.0);
    EXPECT_EQ(geometry.tangent_world[0].w, -1.0);
    EXPECT_EQ(geometry.tangent_world[2].w, 1.0);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 bitangent =
            glm::cross(geometry.normal_world[i], glm::dvec3(geometry.tangent_world[i])) *
            geometry.tangent_world[i].w;
        EXPECT_GT(bitangent.y * (i == 2 ? -1 : 1), 0.0);
    }
    file.primitive()["attributes"].erase("NORMAL");
    EXPECT_TRUE(loadTiny(file).geometry[0].tangent_world.empty()) << "flat normals come with their own";
}

Image decode(const std::string& bytes, std::uint64_t max_texels = 1 << 20) {
    return decodeImage({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                       ColorEncoding::kLinear, max_texels, "test");
}

TEST(DecodeImage, WebpKeepsStraightAlpha) {
    const Image image = decode(test::tinyWebp(5, 3, {64, 200, 100, 50}));
    EXPECT_EQ(glm::ivec2(image.width, image.height), glm::ivec2(5, 3));
    for (const glm::vec4& texel : image.texels) EXPECT_EQ(texel, glm::vec4(200, 100, 50, 64) / 255.0f);
}

TEST(DecodeImage, PicturesMayNotClaimWhatTheirBytesCannotHold) {
    const std::string claim = test::tinyPng(30000, 30000, 8, 0, "");
    EXPECT_THROW(decode(claim, std::uint64_t(1) << 40), InputError);
    EXPECT_THROW(decode(claim), FailureError);
    EXPECT_THROW(decode(test::tinyWebp(16384, 16384, {255, 1, 2, 3})), FailureError);
}

TEST(DecodeImage, WebpTruncationsAreRefused) {
    const std::string webp = test::tinyWebp(2, 2, {255, 1, 2, 3});
    for (std::size_t length = 0; length + 1 < webp.size(); ++length)
        EXPECT_THROW(decode(webp.substr(0, length)), InputError) << length;
}

}  // namespace
}  // namespace edgewise
