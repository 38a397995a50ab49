// One small file for each feature of glTF that takes more than a line: tests look at what becomes of them,
// the fuzzer starts from them.
#pragma once

#include "tests/pipeline/tiny_gltf_file.h"
#include "tests/pipeline/tiny_png.h"
#include "tests/pipeline/tiny_webp.h"

namespace edgewise::test {

/// Joint 0 at (10, 0, 0); joint 1 below it, 2 up and a quarter turn about z, bound at (0, 2, 0). Weights of
/// the three vertices: all on joint 0; a quarter and three quarters; all on joint 1 as (0, 2).
inline TinyGltf skinnedGltf() {
    TinyGltf file;
    const double h = 0.70710678118654752;
    file.root["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {500, 0, 0}}},
                          {{"children", {2}}, {"translation", {10, 0, 0}}},
                          {{"translation", {0, 2, 0}}, {"rotation", {0, 0, h, h}}}};
    file.root["scenes"][0]["nodes"] = {0, 1};
    const int bind = file.accessor<float>("VEC4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -2, 0, 1});
    file.root["accessors"][static_cast<std::size_t>(bind)]["type"] = "MAT4";
    file.root["accessors"][static_cast<std::size_t>(bind)]["count"] = 2;
    file.root["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", bind}}};
    file.primitive()["attributes"]["JOINTS_0"] =
        file.accessor<std::uint8_t>("VEC4", {0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    file.primitive()["attributes"]["WEIGHTS_0"] =
        file.accessor<float>("VEC4", {1, 0, 0, 0, 0.25f, 0.75f, 0, 0, 0, 2, 0, 0});
    file.primitive()["attributes"]["NORMAL"] = file.accessor<float>("VEC3", {0, 0, 1, 1, 0, 0, 1, 0, 0});
    return file;
}

/// Two targets, weights 0.5 and 0 by the mesh. Target 0 moves vertex 1 by (0, 0, 4) and tilts its normal by
/// (2, 0, 0).
inline TinyGltf morphedGltf() {
    TinyGltf file;
    file.primitive()["attributes"]["NORMAL"] = file.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.primitive()["targets"] = {{{"POSITION", file.accessor<float>("VEC3", {0, 0, 0, 0, 0, 4, 0, 0, 0})},
                                    {"NORMAL", file.accessor<float>("VEC3", {0, 0, 0, 2, 0, 0, 0, 0, 0})}},
                                   {{"POSITION", file.accessor<float>("VEC3", {8, 0, 0, 8, 0, 0, 8, 0, 0})}}};
    file.root["meshes"][0]["weights"] = {0.5, 0};
    file.root["nodes"][0]["translation"] = {1, 0, 0};
    return file;
}

/// On a morphed mesh. Animation "move": translation by a cubic spline over [0, 2], scale in steps at 0 and 1,
/// rotation from 0 to a half turn about z over [0, 2], weights from (0, 0) to (1, 0.5) over [0, 1]. Animation
/// "other" lifts the node to z = 9.
inline TinyGltf animatedGltf() {
    TinyGltf file = morphedGltf();
    const int two = file.accessor<float>("SCALAR", {0, 2}), one = file.accessor<float>("SCALAR", {0, 1});
    // In-tangent, value, out-tangent of either key.
    const int spline = file.accessor<float>("VEC3", {9, 9, 9, 0, 0, 0, 1, 0, 0, 2, 0, 0, 4, 0, 0, 9, 9, 9});
    const int steps = file.accessor<float>("VEC3", {1, 1, 1, 3, 3, 3});
    const int turn = file.accessor<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, 32767, 0}, true);
    const int weights = file.accessor<float>("SCALAR", {0, 0, 1, 0.5f});
    const int high = file.accessor<float>("VEC3", {0, 0, 9, 0, 0, 9});
    const auto channel = [](int sampler, const char* path) {
        return nlohmann::json{{"sampler", sampler}, {"target", {{"node", 0}, {"path", path}}}};
    };
    file.root["animations"] = {
        {{"name", "move"},
         {"samplers",
          {{{"input", two}, {"output", spline}, {"interpolation", "CUBICSPLINE"}},
           {{"input", one}, {"output", steps}, {"interpolation", "STEP"}},
           {{"input", two}, {"output", turn}},
           {{"input", one}, {"output", weights}}}},
         {"channels",
          {channel(0, "translation"), channel(1, "scale"), channel(2, "rotation"), channel(3, "weights")}}},
        {{"name", "other"},
         {"samplers", {{{"input", two}, {"output", high}}}},
         {"channels", {channel(0, "translation")}}}};
    return file;
}

/// Three instances: moved, turned a half turn about z (as bytes), scaled by (2, 2, -2).
inline TinyGltf instancedGltf() {
    TinyGltf file;
    file.root["nodes"][0]["translation"] = {100, 0, 0};
    file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", file.accessor<float>("VEC3", {0, 0, 0, 0, 10, 0, 0, 20, 0})},
        {"ROTATION", file.accessor<std::int8_t>("VEC4", {0, 0, 0, 127, 0, 0, 127, 0, 0, 0, 0, 127}, true)},
        {"SCALE", file.accessor<float>("VEC3", {1, 1, 1, 1, 1, 1, 2, 2, -2})}};
    return file;
}

/// A spot light at the end of a moved and turned node, and a light of the sun.
inline TinyGltf litGltf() {
    TinyGltf file;
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"name", "lamp"},
         {"color", {1, 0.5, 0.25}},
         {"intensity", 40},
         {"range", 12},
         {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}}};
    const auto light = [](int index) { return nlohmann::json{{"KHR_lights_punctual", {{"light", index}}}}; };
    // About y by a quarter turn: -z becomes -x. Scales do not count.
    file.root["nodes"] = {
        {{"mesh", 0}, {"children", {1, 2}}, {"scale", {2, 2, 2}}, {"translation", {0, 1, 0}}},
        {{"translation", {1, 2, 3}},
         {"rotation", {0, 0.5, 0, 0.5}},
         {"scale", {3, 4, 5}},
         {"extensions", light(0)}},
        {{"extensions", light(1)}}};
    return file;
}

/// Every slot of a material, of PNG and WebP pictures.
inline TinyGltf texturedGltf() {
    TinyGltf file;
    const std::string png = tinyPng(2, 1, 8, 2, std::string("\x80\x40\xff\x00\x00\x00", 6));
    file.root["images"] = {
        {{"bufferView", file.view(png)}, {"mimeType", "image/png"}},
        {{"bufferView", file.view(tinyWebp(3, 2, {255, 0x80, 0x40, 0x20}))}, {"mimeType", "image/webp"}}};
    file.root["textures"] = {{{"source", 0}}, {{"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    file.root["materials"] = {
        {{"pbrMetallicRoughness",
          {{"metallicFactor", 0.25},
           {"roughnessFactor", 0.75},
           {"baseColorTexture", {{"index", 0}}},
           {"metallicRoughnessTexture", {{"index", 0}}}}},
         {"normalTexture",
          {{"index", 1},
           {"scale", 0.5},
           {"extensions",
            {{"KHR_texture_transform",
              {{"offset", {0, 1}},
               {"rotation", 1.5707963267948966},
               {"scale", {0.5, 0.5}},
               {"texCoord", 1}}}}}}},
         {"occlusionTexture", {{"index", 1}, {"strength", 0.125}}},
         {"emissiveTexture", {{"index", 1}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}}};
    file.primitive()["material"] = 0;
    file.primitive()["attributes"]["NORMAL"] = file.accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.primitive()["attributes"]["TANGENT"] =
        file.accessor<float>("VEC4", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1});
    file.primitive()["attributes"]["TEXCOORD_0"] = file.accessor<float>("VEC2", {0, 0, 1, 0, 0, 1});
    return file;
}

/// Positions with a sparse part over a base, and sparse indices over nothing.
inline TinyGltf sparseGltf() {
    TinyGltf file;
    const int at = file.view(std::vector<std::uint8_t>{2});
    const int value = file.view(std::vector<float>{0, 5, 0});
    file.root["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", value}}}};
    const int where = file.view(std::vector<std::uint8_t>{1, 2});
    file.root["accessors"].push_back({{"componentType", 5121},
                                      {"count", 3},
                                      {"type", "SCALAR"},
                                      {"sparse",
                                       {{"count", 2},
                                        {"indices", {{"bufferView", where}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", where}}}}}});
    file.primitive()["indices"] = 1;
    return file;
}

}  // namespace edgewise::test
