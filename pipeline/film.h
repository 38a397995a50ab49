// The film: which pixels are made, and where the resolved camera stands.
#pragma once

#include <glm/glm.hpp>

#include "pipeline/scene.h"

namespace edgewise {

/// A half-open box of pixels.
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

struct Film {
    int width = 1024, height = 1024;
    PixelBox crop{0, 0, 1024, 1024};
    glm::dvec2 shift_px{0.0};  ///< --shift: the film moves by this, so the picture moves by its negative
    glm::dvec2 debug_offset_px{
        0.0};  ///< whole pixels added to the screen triangles after projection (a test)
};

/// The camera a picture is made with: the file's, the user's own or the framing one.
struct ResolvedCamera {
    Camera camera;  ///< camera.xmag is derived from the film
    glm::dmat4 camera_from_world{1.0};
    std::string origin;  ///< "file", "framing", "command line"
};

}  // namespace edgewise
