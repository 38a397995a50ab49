// How large a pixel is in the world.
#pragma once

#include "pipeline/film.h"

namespace edgewise {

/// What a camera makes of lengths: a point that moves by less than pixelAt() moves by less than a pixel on
/// the film, to first order. With r = |(x, y)| / w of the point in eye space, moves (dx, dw) change its place
/// by scale / w (dx - (x / w) dw), whose largest factor is scale / w sqrt(1 + r^2).
class FilmFootprint {
  public:
    FilmFootprint(const ResolvedCamera& camera, const Film& film);

    /// World units; infinite behind the near plane.
    double pixelAt(const glm::dvec3& p_world) const;
    /// Whether the whole film, not only its crop, holds the point.
    bool sees(const glm::dvec3& p_world) const;

  private:
    glm::dmat4 camera_from_world_;
    glm::dvec2 principal_px_, size_px_;
    double scale_px_, znear_;
    bool perspective_;
};

}  // namespace edgewise
