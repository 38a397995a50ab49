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

    /// World units; behind the near plane as on it.
    double pixelAt(const glm::dvec3& p_world) const { return leastPixel(p_world, 0.0); }
    /// No pixel within a ball is smaller.
    double leastPixel(const glm::dvec3& centre_world, double radius) const;
    /// No part of what a film that is `around_px` larger on every side may see is nearer; 0 within that.
    double awayFromView(const glm::dvec3& p_world, double around_px) const;
    /// Whether the whole film, not only its crop, holds the point.
    bool sees(const glm::dvec3& p_world) const;

  private:
    glm::dmat4 camera_from_world_;
    glm::dvec2 principal_px_, size_px_;
    glm::dvec3 eye(const glm::dvec3& p_world) const {
        return glm::dvec3(camera_from_world_ * glm::dvec4(p_world, 1.0));
    }

    double scale_px_, znear_;
    bool perspective_;
};

}  // namespace edgewise
