// What a target's draw is given of the scene: pieces that may meet it, cut where they reach so far beyond it
// that 32-bit floats would lose their edges.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "analytic/screen_triangle.h"

namespace edgewise::vulkan {

struct ScreenBox {
    glm::dvec2 low{0.0}, high{0.0};
};

struct DrawnPieces {
    std::vector<std::uint32_t> ids;       ///< in owner order; with kClippedPiece an index into `clipped`
    std::vector<ScreenTriangle> clipped;  ///< fans of what is left of a triangle
};

/// The pieces whose boxes meet `target`; those that leave `guard`, which holds it, are cut there. An edge
/// that two triangles share is cut at the same points for both.
DrawnPieces piecesFor(const ScreenScene& scene, const ScreenBox& target, const ScreenBox& guard);

}  // namespace edgewise::vulkan
