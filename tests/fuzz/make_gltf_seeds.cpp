// Writes what load_gltf_fuzz starts from, one small file a feature: make_gltf_seeds FOLDER
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/pipeline/compressed_gltf.h"
#include "tests/pipeline/feature_gltf.h"

namespace {

using edgewise::test::TinyGltf;

/// As gltfFromBytes reads it: JSON, a zero byte, the binary chunk.
std::string split(const TinyGltf& file) {
    return file.glbRoot().dump() + '\0' + file.buffer;
}

TinyGltf withCamera() {
    TinyGltf file;
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}}};
    file.root["nodes"] = {{{"mesh", 0}, {"camera", 0}, {"scale", {1, -1, 1}}}};
    file.primitive()["attributes"]["COLOR_0"] =
        file.accessor<std::uint8_t>("VEC4", std::vector<std::uint8_t>(12, 77), true);
    return file;
}

std::string jpeg() {
    const edgewise::test::TempFolder folder;
    const std::string path = (folder / "a.jpg").string();
    const std::vector<std::uint8_t> pixels(8 * 8 * 3, 100);
    const auto output = OIIO::ImageOutput::create(path);
    output->open(path, OIIO::ImageSpec(8, 8, 3, OIIO::TypeDesc::UINT8));
    output->write_image(OIIO::TypeDesc::UINT8, pixels.data());
    output->close();
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TinyGltf withJpeg() {
    TinyGltf file = edgewise::test::texturedGltf();
    file.root["images"][0] = {{"bufferView", file.view(jpeg())}, {"mimeType", "image/jpeg"}};
    return file;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) return std::fprintf(stderr, "usage: make_gltf_seeds FOLDER\n"), 2;
    using namespace edgewise::test;
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    const std::pair<const char*, TinyGltf> files[] = {{"plain", withCamera()},
                                                      {"jpeg", withJpeg()},
                                                      {"skin", skinnedGltf()},
                                                      {"morph", morphedGltf()},
                                                      {"animation", animatedGltf()},
                                                      {"instances", instancedGltf()},
                                                      {"lights", litGltf()},
                                                      {"textures", texturedGltf()},
                                                      {"sparse", sparseGltf()},
                                                      {"draco", dracoGltf()},
                                                      {"draco_sequential", dracoGltf(false)},
                                                      {"meshopt", meshoptGltf()},
                                                      {"meshopt_strip", meshoptGltf(true)}};
    for (const auto& [name, file] : files) writeFile(folder / name, split(file));
    writeFile(folder / "text", TinyGltf().asGltf());
    writeFile(folder / "binary", TinyGltf().asGlb());
}
