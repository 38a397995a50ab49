// A picture that the program wrote, as floats.
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace edgewise::test {

struct Picture {
    OIIO::ImageSpec spec;
    std::vector<float> values;  ///< the data window's, in rows from the top, channels together
    /// The channels of a pixel of the film.
    const float* at(int x, int y) const {
        return &values[static_cast<std::size_t>((y - spec.y) * spec.width + (x - spec.x)) * spec.nchannels];
    }
};

inline Picture readPicture(const std::filesystem::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) throw std::runtime_error(OIIO::geterror());
    Picture picture{input->spec(), {}};
    picture.values.resize(static_cast<std::size_t>(picture.spec.image_pixels()) * picture.spec.nchannels);
    input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, picture.values.data());
    return picture;
}

}  // namespace edgewise::test
