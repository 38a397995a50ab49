// Accessors, materials and images: the numbers that come out of a file.
#include <gtest/gtest.h>

#include "pipeline/decode_image.h"
#include "pipeline/error.h"
#include "pipeline/load_gltf.h"
#include "pipeline/srgb.h"
#include "tests/pipeline/tiny_gltf_file.h"
#include "tests/pipeline/tiny_png.h"

namespace edgewise {
namespace {

using nlohmann::json;
using test::TempFolder;
using test::TinyGltf;

Scene load(const TinyGltf& file) {
    const TempFolder folder;
    test::writeFile(folder / "a.gltf", file.asGltf());
    return loadGltf(folder / "a.gltf");
}

TEST(LoadGltfData, InterleavedVerticesUseTheStride) {
    TinyGltf file;
    const int view = file.view(std::vector<float>{1, 2, 3, 0.5f, 0, 4, 5, 6, 0.25f, 1, 7, 8, 9, 0.125f, 2});
    file.root["bufferViews"][1]["byteStride"] = 20;
    file.root["accessors"] = {
        {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
        {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}}};
    file.primitive()["attributes"]["TEXCOORD_1"] = 1;
    const Geometry geometry = load(file).geometry[0];
    EXPECT_EQ(geometry.position_world[2], glm::dvec3(7, 8, 9));
    EXPECT_TRUE(geometry.uv[0].empty());
    EXPECT_EQ(geometry.uv[1][2], glm::dvec2(0.125, 2));
}

TEST(LoadGltfData, NormalizedIntegersDivideByTheirMaximum) {
    TinyGltf file;
    file.primitive()["attributes"]["TEXCOORD_0"] =
        file.accessor<std::uint16_t>("VEC2", {0, 65535, 1, 2, 3, 4}, true);
    file.primitive()["attributes"]["COLOR_0"] =
        file.accessor<std::uint8_t>("VEC4", {255, 0, 51, 128, 0, 0, 0, 0, 0, 0, 0, 0}, true);
    const Geometry geometry = load(file).geometry[0];
    EXPECT_EQ(geometry.uv[0][0], glm::dvec2(0, 1));
    EXPECT_EQ(geometry.uv[0][1], glm::dvec2(1 / 65535.0, 2 / 65535.0));
    EXPECT_EQ(geometry.color[0], glm::dvec4(1, 0, 51 / 255.0, 128 / 255.0));
}

TEST(LoadGltfData, ColoursWithoutAlphaAreOpaque) {
    TinyGltf file;
    file.primitive()["attributes"]["COLOR_0"] =
        file.accessor<float>("VEC3", {0.5f, 0.25f, 1, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(load(file).geometry[0].color[0], glm::dvec4(0.5, 0.25, 1, 1));
    TinyGltf shorts;
    shorts.primitive()["attributes"]["COLOR_0"] =
        shorts.accessor<std::uint16_t>("VEC4", std::vector<std::uint16_t>(12, 65535), true);
    EXPECT_EQ(load(shorts).geometry[0].color[2], glm::dvec4(1.0));
}

TEST(LoadGltfData, QuantizedPositionsNeedTheExtensionAndClampTheLowestValue) {
    TinyGltf file;
    file.primitive()["attributes"]["POSITION"] =
        file.accessor<std::int16_t>("VEC3", {-32768, -32767, 0, 0, 32767, 1, 100, -1, 7}, true);
    EXPECT_THROW(load(file), InputError);
    file.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Geometry geometry = load(file).geometry[0];
    EXPECT_EQ(geometry.position_world[0], glm::dvec3(-1, -1, 0));
    EXPECT_EQ(geometry.position_world[2], glm::dvec3(100 / 32767.0, -1 / 32767.0, 7 / 32767.0));
    EXPECT_EQ(geometry.position_file[0], glm::vec3(-32767, -32767, 0))
        << "kept as stored: exact, so coplanar stays coplanar";
}

TEST(LoadGltfData, SparseReplacesElementsWithAndWithoutABase) {
    for (const bool has_base : {true, false}) {
        TinyGltf file;
        const int indices = file.view(std::vector<std::uint16_t>{0, 2});
        const int values = file.view(std::vector<float>{9, 8, 7, 6, 5, 4});
        file.root["accessors"][0]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
            {"values", {{"bufferView", values}}}};
        if (!has_base) file.root["accessors"][0].erase("bufferView");
        const Geometry geometry = load(file).geometry[0];
        EXPECT_EQ(geometry.position_world[0], glm::dvec3(9, 8, 7));
        EXPECT_EQ(geometry.position_world[1], has_base ? glm::dvec3(1, 0, 0) : glm::dvec3(0.0));
        EXPECT_EQ(geometry.position_world[2], glm::dvec3(6, 5, 4));
    }
}

TEST(LoadGltfData, IndicesMayBeSparseWithoutABase) {
    TinyGltf file;
    const int indices = file.view(std::vector<std::uint8_t>{1, 2});
    const int values = file.view(std::vector<std::uint8_t>{2, 1});
    file.root["accessors"].push_back({{"componentType", 5121},
                                      {"count", 3},
                                      {"type", "SCALAR"},
                                      {"sparse",
                                       {{"count", 2},
                                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", values}}}}}});
    file.primitive()["indices"] = 1;
    EXPECT_EQ(load(file).geometry[0].triangles[0], (std::array<std::uint32_t, 3>{0, 2, 1}));
}

TinyGltf textured(const std::string& png) {
    TinyGltf file;
    file.root["images"] = {{{"uri", "data:image/unheard-of;base64," + test::base64(png)}},
                           {{"uri", "never-used.ktx2"}}};
    file.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9985}}};
    file.root["textures"] = {{{"source", 1}}, {{"source", 0}, {"sampler", 0}}};
    file.root["materials"] = {
        {{"name", "unused"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
        {{"name", "used"},
         {"doubleSided", true},
         {"extensions", {{"KHR_materials_unlit", json::object()}}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.25, 0.125, 1}},
           {"baseColorTexture", {{"index", 1}, {"texCoord", 1}}}}}}};
    file.primitive()["material"] = 1;
    return file;
}

TEST(LoadGltfData, MaterialsBringTheirTextures) {
    const Scene scene = load(textured(test::tinyPng(1, 2, 8, 2, std::string("\xff\x00\x80\x00\xff\x00", 6))));
    ASSERT_EQ(scene.materials.size(), 3u);
    const Material& material = scene.materials[1];
    EXPECT_TRUE(material.double_sided && material.unlit);
    EXPECT_EQ(material.base_color, glm::dvec4(0.5, 0.25, 0.125, 1));
    EXPECT_EQ(material.base_color_map.uv, 1);
    EXPECT_EQ(scene.geometry[0].uv[1].size(), 3u) << "absent coordinates are read as (0, 0)";
    ASSERT_EQ(material.base_color_map.texture, 0u);
    const Texture& texture = scene.textures[0];
    EXPECT_EQ(texture.wrap_s, Wrap::kClampToEdge);
    EXPECT_EQ(texture.wrap_t, Wrap::kMirroredRepeat);
    EXPECT_EQ(texture.mag, TexelFilter::kNearest);
    EXPECT_EQ(texture.min, TexelFilter::kLinear);
    EXPECT_EQ(texture.mip, TexelFilter::kNearest);
    const Image& image = scene.images[texture.image];
    EXPECT_EQ(glm::ivec2(image.width, image.height), glm::ivec2(1, 2));
    EXPECT_EQ(image.texels[0], glm::vec4(1, 0, static_cast<float>(decodeSrgb(128 / 255.0)), 1))
        << "row 0 is the top";
    EXPECT_EQ(image.texels[1], glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(scene.materials[0].base_color_map.texture, kNone)
        << "the unused material's picture is not even opened";
    EXPECT_EQ(scene.materials[2].base_color, glm::dvec4(1.0));
}

TEST(LoadGltfData, PrimitivesWithoutMaterialGetTheDefault) {
    const Scene scene = load(TinyGltf());
    EXPECT_EQ(scene.geometry[0].material, 0u);
    EXPECT_EQ(scene.materials[0].name, "default");
    EXPECT_FALSE(scene.materials[0].double_sided);
}

TEST(DecodeImage, SrgbCurveHasItsPublishedConstants) {
    EXPECT_EQ(decodeSrgb(0.0), 0.0);
    EXPECT_EQ(decodeSrgb(1.0), 1.0);
    EXPECT_EQ(decodeSrgb(0.04045), 0.04045 / 12.92);
    EXPECT_NEAR(decodeSrgb(0.5), 0.21404114048223255,
                4 * 0x1p-53);  // ((0.5 + 0.055) / 1.055)^2.4 to 17 digits
    // The pieces were joined at rounded constants: IEC 61966-2-1 leaves a step of 2.3e-8 there.
    EXPECT_LT(std::abs(decodeSrgb(0.04045) - decodeSrgb(std::nextafter(0.04045, 1.0))), 3e-8);
}

Image decode(const std::string& bytes) {
    return decodeImage({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                       ColorEncoding::kSrgb, std::uint64_t(1) << 26, "test");
}

TEST(DecodeImage, GreyAlphaAndSixteenBits) {
    const auto linear = [](double encoded) { return static_cast<float>(decodeSrgb(encoded)); };
    EXPECT_EQ(decode(test::tinyPng(1, 1, 8, 0, "\x33")).texels[0],
              glm::vec4(glm::vec3(linear(0x33 / 255.0)), 1.0f));
    EXPECT_EQ(decode(test::tinyPng(1, 1, 8, 4, std::string("\xff\x40", 2))).texels[0],
              glm::vec4(1, 1, 1, static_cast<float>(64 / 255.0)));
    EXPECT_EQ(decode(test::tinyPng(1, 1, 8, 6, std::string("\xff\x33\x00\x00", 4))).texels[0],
              glm::vec4(1, linear(0x33 / 255.0), 0, 0))
        << "straight alpha: colour survives alpha 0";
    EXPECT_EQ(decode(test::tinyPng(1, 1, 16, 2, std::string("\xff\xff\x12\x34\x00\x01", 6))).texels[0],
              glm::vec4(1, linear(0x1234 / 65535.0), linear(1 / 65535.0), 1));
    EXPECT_EQ(decode(test::tinyPng(2, 1, 1, 0, "\x40")).texels[1], glm::vec4(1.0f)) << "one bit";
}

TEST(DecodeImage, OtherPngChunksAreLeftOutAndDamageIsFound) {
    const std::string png = test::tinyPng(1, 1, 8, 2, "abc");
    const std::string with_gamma =
        png.substr(0, 33) + test::pngChunk("gAMA", std::string("\0\1\0\0", 4)) + png.substr(33);
    EXPECT_EQ(decode(with_gamma).texels, decode(png).texels);
    for (std::size_t length = 0; length < png.size(); ++length)
        EXPECT_THROW(decode(png.substr(0, length)), InputError) << length;
    for (std::size_t at = 0; at < png.size(); ++at) {
        std::string damaged = png;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        EXPECT_THROW(decode(damaged), InputError) << at;
    }
}

TEST(DecodeImage, MorePixelsThanTheLimitAreAFailure) {
    EXPECT_THROW(decode(test::tinyPng(60000, 60000, 8, 0, "")), FailureError);
}

}  // namespace
}  // namespace edgewise
