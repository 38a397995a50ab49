// From eye space (camera at the origin, looking down -z, +y up) to the screen and back.
#pragma once

#include <glm/glm.hpp>

#include "pipeline/film.h"

namespace edgewise {

/// x_px = principal.x + scale x / w, y_px = principal.y - scale y / w, with w = -z for perspective, 1 for
/// orthographic. The principal point is held as a whole pixel and a fraction in [0, 1), so that moving the
/// film by whole pixels moves every rounded position by exactly that.
struct ScreenMap {
    bool perspective = true;
    double scale_px = 1.0;     ///< (H / 2) / tan(yfov / 2), or (H / 2) / ymag
    glm::dvec2 whole_px{0.0};  ///< of the principal point
    glm::dvec2 fraction_px{0.0};
    glm::dvec2 offset_px{0.0};  ///< Film::debug_offset_px: added to positions after rounding

    double w(const glm::dvec3& p_eye) const { return perspective ? -p_eye.z : 1.0; }

    /// On the grid of 2^-32 px, rounded half to even and clamped to the guard band; w > 0.
    glm::dvec2 toScreen(const glm::dvec3& p_eye) const;

    /// The ray through a pixel position: perspective (u, v, -1) through the eye; orthographic (u, v) is the
    /// point itself.
    /// The position is p + delta, so that a short delta keeps its digits: whole pixels added to p and offset
    /// change no bit.
    glm::dvec2 toImagePlane(glm::dvec2 p_px, glm::dvec2 delta_px) const;

    /// The principal point on the grid, where depth planes are anchored.
    glm::dvec2 anchorPx() const;
};

ScreenMap makeScreenMap(const ResolvedCamera& camera, const Film& film);

/// The nearest multiple of 2^-32, half to even; |x| <= 2^20.
double roundToGrid(double x_px);

}  // namespace edgewise
