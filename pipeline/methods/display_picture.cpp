#include "pipeline/methods/display_picture.h"

#include <glm/common.hpp>

#include "pipeline/srgb.h"

namespace edgewise {

EncodedPicture encodePicture(const ImageBuffer& image) {
    EncodedPicture encoded(image.box.width(), image.box.height());
    tbb::parallel_for(0, encoded.height(), [&](int y) {
        const std::size_t row = image.index(image.box.x0, image.box.y0 + y);
        for (int x = 0; x < encoded.width(); ++x)
            for (int c = 0; c < 3; ++c)
                encoded.texel(x, y)[c] = static_cast<float>(encodeSrgb(image.rgba[row + x][c]));
    });
    return encoded;
}

glm::vec3 quantized(const glm::vec3& encoded) {
    return glm::floor(glm::clamp(encoded, 0.0f, 1.0f) * 255.0f + 0.5f) / 255.0f;
}

Texels<float> lumaOf(const EncodedPicture& picture, const glm::vec3& weights) {
    Texels<float> luma(picture.width(), picture.height());
    tbb::parallel_for(0, picture.height(), [&](int y) {
        for (int x = 0; x < picture.width(); ++x) {
            const glm::vec3 color = quantized(picture.at(x, y));
            luma.texel(x, y) = color.r * weights.r + color.g * weights.g + color.b * weights.b;
        }
    });
    return luma;
}

}  // namespace edgewise
