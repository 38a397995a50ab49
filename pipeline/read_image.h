// A picture from elsewhere: the reverse of write_image.
#pragma once

#include <filesystem>

#include "pipeline/image_buffer.h"

namespace edgewise {

struct PictureFile {
    ImageBuffer image;          ///< the part that the file holds
    int width = 0, height = 0;  ///< of the whole picture
};

/// PNG: sRGB, any depth, straight alpha. EXR: linear, RGB or Y, A and `edge` where it has them; the data
/// window is the image's box, moved so that the display window starts at 0,0. Other channels are left out.
/// Throws InputError for what cannot be read, has no colour, or holds a value that is not finite.
PictureFile readImage(const std::filesystem::path& path);

}  // namespace edgewise
