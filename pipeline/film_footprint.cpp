#include "pipeline/film_footprint.h"

#include <cmath>
#include <limits>

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

double FilmFootprint::pixelAt(const glm::dvec3& p_world) const {
    if (!perspective_) return 1.0 / scale_px_;
    const glm::dvec3 p_eye(camera_from_world_ * glm::dvec4(p_world, 1.0));
    const double w = -p_eye.z;
    if (!(w >= znear_)) return std::numeric_limits<double>::infinity();
    const double r = std::hypot(p_eye.x, p_eye.y) / w;
    return w / (scale_px_ * std::sqrt(1.0 + r * r));
}

bool FilmFootprint::sees(const glm::dvec3& p_world) const {
    const glm::dvec3 p_eye(camera_from_world_ * glm::dvec4(p_world, 1.0));
    const double w = perspective_ ? -p_eye.z : 1.0;
    if (!(-p_eye.z >= znear_)) return false;
    const glm::dvec2 p_px = principal_px_ + scale_px_ / w * glm::dvec2(p_eye.x, -p_eye.y);
    return p_px.x >= 0.0 && p_px.y >= 0.0 && p_px.x <= size_px_.x && p_px.y <= size_px_.y;
}

}  // namespace edgewise
