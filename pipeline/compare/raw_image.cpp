#include "pipeline/compare/raw_image.h"

#include <fstream>

#include "pipeline/error.h"

namespace edgewise::compare {
namespace {

template <class T>
void put(std::ofstream& file, const T* items, std::size_t count) {
    file.write(reinterpret_cast<const char*>(items), static_cast<std::streamsize>(count * sizeof(T)));
}
template <class T>
void get(std::ifstream& file, T* items, std::size_t count) {
    file.read(reinterpret_cast<char*>(items), static_cast<std::streamsize>(count * sizeof(T)));
}

}  // namespace

void writeRaw(const std::filesystem::path& path, const ImageBuffer& image) {
    std::ofstream file(path, std::ios::binary);
    put(file, &image.box, 1);
    put(file, image.rgba.data(), image.rgba.size());
    put(file, image.edge.data(), image.edge.size());
    if (!file.flush()) throw FailureError(path.string(), "cannot be written");
}

ImageBuffer readRaw(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    PixelBox box{};
    get(file, &box, 1);
    ImageBuffer image(file ? box : PixelBox{});
    get(file, image.rgba.data(), image.rgba.size());
    get(file, image.edge.data(), image.edge.size());
    if (!file) throw FailureError(path.string(), "is no picture of a method");
    return image;
}

}  // namespace edgewise::compare
