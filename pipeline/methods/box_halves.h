// What is too large for a device at once is halved.
#pragma once

#include <array>

#include "pipeline/film.h"

namespace edgewise {

/// The longer side is cut. The first half is a multiple of `unit_px`, and the larger one.
inline std::array<PixelBox, 2> halvesOf(const PixelBox& box, int unit_px = 1) {
    const auto middle = [=](int from, int to) {
        const int units = ((to - from) + 2 * unit_px - 1) / (2 * unit_px);
        return from + units * unit_px;
    };
    std::array<PixelBox, 2> halves{box, box};
    if (box.width() > box.height())
        halves[0].x1 = halves[1].x0 = middle(box.x0, box.x1);
    else
        halves[0].y1 = halves[1].y0 = middle(box.y0, box.y1);
    return halves;
}

}  // namespace edgewise
