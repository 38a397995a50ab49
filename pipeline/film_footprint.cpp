#include "pipeline/film_footprint.h"

#include <algorithm>
#include <cmath>

#include "pipeline/screen_map.h"

namespace edgewise {

FilmFootprint::FilmFootprint(const ResolvedCamera& camera, const Film& film)
    : camera_from_world_(camera.camera_from_world),
      size_px_(film.width, film.height),
      znear_(camera.camera.znear) {
    const ScreenMap map = makeScreenMap(camera, film);
    principal_px_ = map.whole_px + map.fraction_px + map.offset_px;
    scale_px_ = map.scale_px;
    perspective_ = map.perspective;
}

double FilmFootprint::leastPixel(const glm::dvec3& centre, double radius) const {
    if (!perspective_) return 1.0 / scale_px_;
    const glm::dvec3 p_eye = eye(centre);
    // w^2 / (scale |p|)
    const double w = std::max(-p_eye.z - radius, znear_);
    return w * w / (scale_px_ * (std::hypot(p_eye.x, p_eye.y, p_eye.z) + radius));
}

double FilmFootprint::awayFromView(const glm::dvec3& p_world, double around_px) const {
    const glm::dvec3 p_eye = eye(p_world);
    double away = znear_ + p_eye.z;
    for (int axis = 0; axis < 2; ++axis)
        for (const double side : {-1.0, 1.0}) {
            // Outside is where side * (place on the film - border) > 0.
            const double border_px = side < 0.0 ? -around_px : size_px_[axis] + around_px;
            const double slope = (border_px - principal_px_[axis]) / scale_px_;
            const double place = axis == 0 ? p_eye.x : -p_eye.y;
            away = std::max(away, perspective_ ? side * (place + slope * p_eye.z) / std::hypot(1.0, slope)
                                               : side * (place - slope));
        }
    return std::max(away, 0.0);
}

bool FilmFootprint::sees(const glm::dvec3& p_world) const {
    const glm::dvec3 p_eye = eye(p_world);
    const double w = perspective_ ? -p_eye.z : 1.0;
    if (!(-p_eye.z >= znear_)) return false;
    const glm::dvec2 p_px = principal_px_ + scale_px_ / w * glm::dvec2(p_eye.x, -p_eye.y);
    return p_px.x >= 0.0 && p_px.y >= 0.0 && p_px.x <= size_px_.x && p_px.y <= size_px_.y;
}

}  // namespace edgewise
