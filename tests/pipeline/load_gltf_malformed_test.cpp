// A table of spoiled files: each is refused by the name of the element, in one line.
#include <gtest/gtest.h>

#include <functional>

#include "tests/pipeline/load_problem.h"
#include "tests/pipeline/tiny_gltf_file.h"
#include "tests/pipeline/tiny_png.h"

namespace edgewise {
namespace {

using nlohmann::json;
using test::problemOf;
using test::TinyGltf;

struct Malformed {
    const char* expected;  ///< the message starts so
    std::function<void(TinyGltf&)> spoil;
};

template <class Edit>
Malformed root(const char* expected, const Edit& edit) {
    return {expected, [edit](TinyGltf& file) { edit(file.root); }};
}

void addSparse(TinyGltf& file, const std::vector<std::uint8_t>& indices) {
    const int index_view = file.view(indices);
    const int value_view = file.view(std::vector<float>(indices.size() * 3, 0.5f));
    file.root["accessors"][0]["sparse"] = {{"count", indices.size()},
                                           {"indices", {{"bufferView", index_view}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", value_view}}}};
}

void addTexture(TinyGltf& file, const std::string& image_bytes) {
    file.root["images"] = {{{"bufferView", file.view(image_bytes)}, {"mimeType", "image/png"}}};
    file.root["textures"] = {{{"source", 0}}};
    file.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.primitive()["material"] = 0;
}

const std::vector<Malformed>& table() {
    static const std::vector<Malformed> rows{
        root("asset: ", [](json& j) { j["asset"] = 3; }),
        root("asset is missing", [](json& j) { j.erase("asset"); }),
        root("asset: version is missing", [](json& j) { j["asset"].erase("version"); }),
        root("asset.version: 1.0 is not supported", [](json& j) { j["asset"]["version"] = "1.0"; }),
        root("asset.version: 3.0 is not supported", [](json& j) { j["asset"]["version"] = "3.0"; }),
        root("asset.version: \"two\"", [](json& j) { j["asset"]["version"] = "two"; }),
        root("asset.version: is a number", [](json& j) { j["asset"]["version"] = 2.0; }),
        root("asset.minVersion: 2.1", [](json& j) { j["asset"]["minVersion"] = "2.1"; }),
        root("extensionsRequired[1]: the file requires the extension KHR_texture_basisu",
             [](json& j) {
                 j["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_texture_basisu"};
             }),
        root("extensionsUsed: is a string", [](json& j) { j["extensionsUsed"] = "x"; }),
        root("scene: 1 is out of range", [](json& j) { j["scene"] = 1; }),
        root("scene: 0.5 is not a whole number", [](json& j) { j["scene"] = 0.5; }),
        root("scene: -1 is below 0", [](json& j) { j["scene"] = -1; }),
        root("scenes[0].nodes[0]: 1 is out of range", [](json& j) { j["scenes"][0]["nodes"] = {1}; }),
        root("scenes[0].nodes[1]: nodes[0] is listed twice",
             [](json& j) {
                 j["scenes"][0]["nodes"] = {0, 0};
             }),
        root("nodes: is an object", [](json& j) { j["nodes"] = json::object(); }),
        root("nodes[0]: is a number", [](json& j) { j["nodes"][0] = 7; }),
        root("nodes[0].mesh: 5 is out of range", [](json& j) { j["nodes"][0]["mesh"] = 5; }),
        root("nodes[0].camera: 0 is out of range", [](json& j) { j["nodes"][0]["camera"] = 0; }),
        root("nodes[0].skin: 0 is out of range", [](json& j) { j["nodes"][0]["skin"] = 0; }),
        root("nodes[0].children[0]: 4294967296 is above",
             [](json& j) { j["nodes"][0]["children"] = {4294967296}; }),
        root("nodes[0].children[0]: 1e+300", [](json& j) { j["nodes"][0]["children"] = {1e300}; }),
        root("nodes[0]: is its own ancestor", [](json& j) { j["nodes"][0]["children"] = {0}; }),
        root("nodes[1]: is its own ancestor",
             [](json& j) {
                 j["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
             }),
        root("nodes[1].children[0]: nodes[2] already has the parent nodes[0]",
             [](json& j) {
                 j["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, json::object()};
             }),
        root("nodes[0].children[1]: nodes[1] already has",
             [](json& j) {
                 j["nodes"] = {{{"children", {1, 1}}}, json::object()};
             }),
        root("nodes[1]: the scene lists it and one of its ancestors",
             [](json& j) {
                 j["nodes"] = {{{"children", {1}}}, json::object()};
                 j["scenes"][0]["nodes"] = {0, 1};
             }),
        root("nodes[0].matrix: has 15 numbers, not 16",
             [](json& j) { j["nodes"][0]["matrix"] = json(std::vector<double>(15)); }),
        root("nodes[0].matrix[15]: 0",
             [](json& j) { j["nodes"][0]["matrix"] = json(std::vector<double>(16)); }),
        root("nodes[0]: has both a matrix and a scale",
             [](json& j) {
                 j["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
                 j["nodes"][0]["scale"] = {1, 1, 1};
             }),
        root("nodes[0].rotation: is the quaternion 0",
             [](json& j) {
                 j["nodes"][0]["rotation"] = {0, 0, 0, 0};
             }),
        root("nodes[0].scale[1]: is a string",
             [](json& j) {
                 j["nodes"][0]["scale"] = {1, "1", 1};
             }),
        root("nodes[0].name: is null", [](json& j) { j["nodes"][0]["name"] = nullptr; }),
        root("nodes[1]: its world transform is not finite",
             [](json& j) {
                 j["nodes"] = {{{"scale", {1e200, 1e200, 1e200}}, {"children", {1}}},
                               {{"scale", {1e200, 1, 1}}}};
             }),
        root("nodes[0]: a vertex is not finite in world space",
             [](json& j) {
                 j["nodes"][0]["scale"] = {1.7e308, 1, 1};
                 j["nodes"][0]["translation"] = {1.7e308, 0, 0};
             }),
        root("extensionsRequired[0]: the file requires the extension KHR_texture_basisu",
             [](json& j) { j["extensionsRequired"] = {"KHR_texture_basisu"}; }),
        root("extensionsRequired[0]: the file requires the extension KHR_materials_transmission",
             [](json& j) { j["extensionsRequired"] = {"KHR_materials_transmission"}; }),
        root("meshes[0].primitives[0].attributes: is empty",
             [](json& j) { j["meshes"][0]["primitives"][0]["attributes"] = json::object(); }),
        root("nodes[0].weights[0]: is a string", [](json& j) { j["nodes"][0]["weights"] = {"1"}; }),
        root("meshes[0].weights: is a number", [](json& j) { j["meshes"][0]["weights"] = 1; }),
        root("animations[0].channels[0].sampler: 0 is out of range",
             [](json& j) {
                 j["animations"] = {{{"channels", {{{"sampler", 0}}}}}};
             }),
        root("animations[0].channels[0].target.node: 7 is out of range",
             [](json& j) {
                 j["animations"] = {
                     {{"samplers", {{{"input", 0}, {"output", 0}}}},
                      {"channels", {{{"sampler", 0}, {"target", {{"node", 7}, {"path", "scale"}}}}}}}};
             }),
        root("animations[0].samplers[0].input: 5 is out of range",
             [](json& j) {
                 j["animations"] = {{{"samplers", {{{"input", 5}, {"output", 0}}}}}};
             }),
        root("materials[0].pbrMetallicRoughness.metallicFactor: 1.5 is not in [0, 1]",
             [](json& j) {
                 j["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 1.5}}}}};
             }),
        root("materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength: -1 is negative",
             [](json& j) {
                 j["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = -1;
             }),
        root("materials[0].normalTexture.scale: 1e+300 is beyond the range of a 32-bit float",
             [](json& j) {
                 j["textures"] = {json::object()};
                 j["materials"] = {{{"normalTexture", {{"index", 0}, {"scale", 1e300}}}}};
             }),
        root("materials[0].extensions: is a number",
             [](json& j) {
                 j["materials"] = {{{"extensions", 3}}};
             }),
        root("meshes[0]: primitives is missing", [](json& j) { j["meshes"][0].erase("primitives"); }),
        root("meshes[0]: has no primitives", [](json& j) { j["meshes"][0]["primitives"] = json::array(); }),
        root("meshes[0].primitives[0]: attributes is missing",
             [](json& j) { j["meshes"][0]["primitives"][0].erase("attributes"); }),
        root("meshes[0].primitives[0].attributes.POSITION: 9 is out of range",
             [](json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }),
        root("meshes[0].primitives[0].indices: 9 is out of range",
             [](json& j) { j["meshes"][0]["primitives"][0]["indices"] = 9; }),
        root("meshes[0].primitives[0].material: 0 is out of range",
             [](json& j) { j["meshes"][0]["primitives"][0]["material"] = 0; }),
        root("meshes[0].primitives[0].targets[0].POSITION: 4 is out of range",
             [](json& j) {
                 j["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 4}}};
             }),
        root("meshes[0].primitives[0].indices: may not have",
             [](json& j) { j["meshes"][0]["primitives"][0]["indices"] = 0; }),
        root("accessors[0]: count is missing", [](json& j) { j["accessors"][0].erase("count"); }),
        root("accessors[0].count: 0 is below 1", [](json& j) { j["accessors"][0]["count"] = 0; }),
        root("accessors[0]: ends at byte 48", [](json& j) { j["accessors"][0]["count"] = 4; }),
        root("accessors[0]: ends at byte 51539607540",
             [](json& j) { j["accessors"][0]["count"] = 4294967295u; }),
        root("accessors[0]: ends at byte 40", [](json& j) { j["accessors"][0]["byteOffset"] = 4; }),
        root("accessors[0]: starts at byte 2", [](json& j) { j["accessors"][0]["byteOffset"] = 2; }),
        root("accessors[0].bufferView: 3 is out of range",
             [](json& j) { j["accessors"][0]["bufferView"] = 3; }),
        root("accessors[0].componentType: 5124", [](json& j) { j["accessors"][0]["componentType"] = 5124; }),
        root("accessors[0].type: \"VEC5\"", [](json& j) { j["accessors"][0]["type"] = "VEC5"; }),
        root("accessors[0]: is normalized", [](json& j) { j["accessors"][0]["normalized"] = true; }),
        root("accessors[0].normalized: is a number", [](json& j) { j["accessors"][0]["normalized"] = 1; }),
        root("meshes[0].primitives[0].attributes.POSITION: may not have component type 5123",
             [](json& j) { j["accessors"][0]["componentType"] = 5123; }),
        root("bufferViews[0]: byteLength is missing",
             [](json& j) { j["bufferViews"][0].erase("byteLength"); }),
        root("bufferViews[0]: ends at byte 37", [](json& j) { j["bufferViews"][0]["byteLength"] = 37; }),
        root("bufferViews[0]: ends at byte 4294967331",
             [](json& j) { j["bufferViews"][0]["byteOffset"] = 4294967295u; }),
        root("bufferViews[0].buffer: 1 is out of range", [](json& j) { j["bufferViews"][0]["buffer"] = 1; }),
        root("bufferViews[0].byteStride: 6 is not a multiple",
             [](json& j) { j["bufferViews"][0]["byteStride"] = 6; }),
        root("accessors[0]: has elements of 12 bytes",
             [](json& j) { j["bufferViews"][0]["byteStride"] = 8; }),
        root("accessors[0]: its buffer has no uri",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}}};
             }),
        root("buffers[0].uri: no such file",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "no.bin"}}};
             }),
        root("buffers[0].uri: \"../../etc/passwd\" leaves",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "../../etc/passwd"}}};
             }),
        root("buffers[0].uri: \"../x\" leaves",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "%2e%2E/x"}}};
             }),
        root("buffers[0].uri: \"/etc/passwd\" is an absolute path",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "/etc/passwd"}}};
             }),
        root("buffers[0].uri: \"https://x.example/a.bin\" is not a relative path",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "https://x.example/a.bin"}}};
             }),
        root("buffers[0].uri: \"file:///etc/passwd\" is not",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "file:///etc/passwd"}}};
             }),
        root("buffers[0].uri: has a %",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "a%2"}}};
             }),
        root("buffers[0].uri: is a data URI that is not base64",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "data:,abc"}}};
             }),
        root("buffers[0].uri: is a data URI with broken base64",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "data:a/b;base64,a$bc"}}};
             }),
        root("buffers[0]: byteLength is 36, but there are 3 bytes",
             [](json& j) {
                 j["buffers"] = {{{"byteLength", 36}, {"uri", "data:a/b;base64,AAAA"}}};
             }),
        root("images[0]: needs either", [](json& j) { j["images"] = {json::object()}; }),
        root("images[0].uri: \"../x.png\" leaves",
             [](json& j) {
                 j["images"] = {{{"uri", "../x.png"}}};
             }),
        root("images[0].bufferView: 8 is out of range",
             [](json& j) {
                 j["images"] = {{{"bufferView", 8}}};
             }),
        root("textures[0].source: 0 is out of range",
             [](json& j) {
                 j["textures"] = {{{"source", 0}}};
             }),
        root("textures[0].sampler: 2 is out of range",
             [](json& j) {
                 j["textures"] = {{{"sampler", 2}}};
             }),
        root("materials[0].doubleSided: is a number",
             [](json& j) {
                 j["materials"] = {{{"doubleSided", 1}}};
             }),
        root("materials[0].pbrMetallicRoughness.baseColorFactor[0]: 2 is not in [0, 1]",
             [](json& j) {
                 j["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {2, 0, 0, 1}}}}}};
             }),
        root("materials[0].pbrMetallicRoughness.baseColorTexture: index is missing",
             [](json& j) {
                 j["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", json::object()}}}}};
             }),
        root("materials[0].normalTexture.index: 3 is out of range",
             [](json& j) {
                 j["materials"] = {{{"normalTexture", {{"index", 3}}}}};
             }),
        root("cameras[0]: perspective is missing",
             [](json& j) {
                 j["cameras"] = {{{"type", "perspective"}}};
             }),
        root("cameras[0].perspective: yfov is missing",
             [](json& j) {
                 j["cameras"] = {{{"type", "perspective"}, {"perspective", {{"znear", 1}}}}};
             }),
        root("cameras[0].perspective.zfar: 0 is not above 0",
             [](json& j) {
                 j["cameras"] = {
                     {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 0}}}}};
             }),
        root("nodes[0]: its camera has no orientation",
             [](json& j) {
                 j["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
                 j["nodes"][0] = {{"camera", 0}, {"scale", {1, 1, 0}}};
             }),
        root("skins[0].joints[0]: 9 is out of range",
             [](json& j) {
                 j["skins"] = {{{"joints", {9}}}};
             }),
        {"accessors[0]: element 2 is nan",
         [](TinyGltf& f) { std::memcpy(&f.buffer[24], "\0\0\xc0\x7f", 4); }},
        {"accessors[0]: element 0 is -inf",
         [](TinyGltf& f) { std::memcpy(&f.buffer[4], "\0\0\x80\xff", 4); }},
        {"accessors[1]: element 0 is nan",
         [](TinyGltf& f) {
             f.primitive()["attributes"]["NORMAL"] = f.accessor<float>("VEC3", std::vector<float>(9, NAN));
         }},
        {"meshes[0].primitives[0].indices: index 1 is 3, but there are 3 vertices",
         [](TinyGltf& f) {
             f.primitive()["indices"] = f.accessor<std::uint16_t>("SCALAR", {0, 3, 1});
         }},
        {"meshes[0].primitives[0].attributes.TEXCOORD_0: has 2 elements, POSITION has 3",
         [](TinyGltf& f) {
             f.primitive()["attributes"]["TEXCOORD_0"] = f.accessor<float>("VEC2", {0, 0, 1, 1});
         }},
        {"meshes[0].primitives[0].attributes.COLOR_0: may not have",
         [](TinyGltf& f) {
             f.primitive()["attributes"]["COLOR_0"] =
                 f.accessor<std::uint32_t>("VEC4", std::vector<std::uint32_t>(12));
         }},
        {"accessors[0].sparse: index 3 is out of range",
         [](TinyGltf& f) {
             addSparse(f, {1, 3});
         }},
        {"accessors[0].sparse: index 1 follows 1",
         [](TinyGltf& f) {
             addSparse(f, {1, 1});
         }},
        {"accessors[0].sparse: replaces 4 of 3 elements",
         [](TinyGltf& f) {
             addSparse(f, {0, 1, 2, 2});
         }},
        {"accessors[0].sparse.values: ends at byte 24",
         [](TinyGltf& f) {
             addSparse(f, {0, 1});
             f.root["bufferViews"][2]["byteLength"] = 20;
         }},
        {"accessors[0].sparse: indices is missing",
         [](TinyGltf& f) {
             addSparse(f, {0});
             f.root["accessors"][0]["sparse"].erase("indices");
         }},
        {"bufferViews[1]: ends at byte",
         [](TinyGltf& f) {
             addTexture(f, test::tinyPng(1, 1, 8, 2, "abc"));
             f.root["bufferViews"][1]["byteLength"] = 100000;
         }},
        {"images[0]: 60000 x 1000 pixels are more than its bytes hold",
         [](TinyGltf& f) { addTexture(f, test::tinyPng(60000, 1000, 8, 0, "")); }},
        {"images[0]: is a WebP that is damaged or cut off",
         [](TinyGltf& f) { addTexture(f, "RIFF....WEBPVP8 "); }},
        {"images[0]: is a PNG that is cut off",
         [](TinyGltf& f) { addTexture(f, test::tinyPng(2, 2, 8, 2, std::string(12, 'x')).substr(0, 50)); }},
        {"images[0]: is a damaged PNG: ",
         [](TinyGltf& f) { addTexture(f, test::tinyPng(2, 2, 8, 2, std::string(4, 'x'))); }},
        {"images[0]: ", [](TinyGltf& f) { addTexture(f, "\xff\xd8\xff\xe0 not a picture"); }},
        {"images[0] gone.png: cannot be read",
         [](TinyGltf& f) {
             addTexture(f, "x");
             f.root["images"] = {{{"uri", "gone.png"}}};
         }},
    };
    return rows;
}

TEST(LoadGltfMalformed, TheUnspoiledFileLoads) {
    EXPECT_EQ(problemOf(TinyGltf().asGltf()), "");
}

TEST(LoadGltfMalformed, EveryRowIsRefusedByName) {
    for (const Malformed& row : table()) {
        TinyGltf file;
        row.spoil(file);
        EXPECT_EQ(problemOf(file.asGltf()).substr(0, std::strlen(row.expected)), row.expected)
            << "whole message: " << problemOf(file.asGltf());
    }
}

}  // namespace
}  // namespace edgewise
