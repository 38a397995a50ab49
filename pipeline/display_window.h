// The whole of a picture of which a file may hold a part.
#pragma once

#include <filesystem>
#include <optional>

#include "pipeline/film.h"

namespace edgewise {

/// An EXR's display window, in the coordinates of its data window; nothing for any other file.
std::optional<PixelBox> displayWindow(const std::filesystem::path& path);

}  // namespace edgewise
