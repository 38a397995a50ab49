// A picture from one process to another, every bit of it: the box, RGBA in double, the edge channel.
#pragma once

#include <filesystem>

#include "pipeline/image_buffer.h"

namespace edgewise::compare {

/// Throws FailureError where the file cannot be written whole.
void writeRaw(const std::filesystem::path& path, const ImageBuffer& image);
/// Of the same machine. Throws FailureError for what writeRaw() has not written.
ImageBuffer readRaw(const std::filesystem::path& path);

}  // namespace edgewise::compare
