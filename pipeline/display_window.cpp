#include "pipeline/display_window.h"

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string_view>

namespace edgewise {

std::optional<PixelBox> displayWindow(const std::filesystem::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input || std::string_view(input->format_name()) != "openexr") {
        static_cast<void>(OIIO::geterror());  // else it is printed when the program ends
        return std::nullopt;
    }
    const OIIO::ImageSpec& spec = input->spec();
    return PixelBox{spec.full_x, spec.full_y, spec.full_x + spec.full_width, spec.full_y + spec.full_height};
}

}  // namespace edgewise
