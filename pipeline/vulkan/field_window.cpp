#include "pipeline/vulkan/field_window.h"

#include <cmath>

namespace edgewise::vulkan {
namespace {

/// Pixels as rays: x right, y down, pixel (i, j)'s middle at (i + 0.5, j + 0.5).
class CameraRays {
  public:
    CameraRays(const ResolvedCamera& camera, const Film& film)
        : perspective_(camera.camera.perspective),
          world_(glm::inverse(camera.camera_from_world)),
          center_px_(glm::dvec2(film.width, film.height) * 0.5 - film.shift_px) {
        const double half = perspective_ ? std::tan(0.5 * camera.camera.yfov) : camera.camera.ymag;
        unit_ = 2.0 * half / film.height;
    }

    GpuRay at(const glm::dvec2& p_px, double far, const glm::dvec4& bounds) const {
        const glm::dvec2 offset((p_px.x - center_px_.x) * unit_, (center_px_.y - p_px.y) * unit_);
        const glm::dvec3 eye = perspective_ ? glm::dvec3(0.0) : glm::dvec3(offset, 0.0);
        const glm::dvec3 towards = perspective_ ? glm::dvec3(offset, -1.0) : glm::dvec3(0.0, 0.0, -1.0);
        const glm::dvec3 o(world_ * glm::dvec4(eye, 1.0)), d = glm::normalize(glm::dmat3(world_) * towards);
        GpuRay ray;
        for (int k = 0; k < 3; ++k)
            ray.origin[k] = static_cast<float>(o[k]), ray.direction[k] = static_cast<float>(d[k]);
        ray.t_min = 0.0f;
        ray.t_max = static_cast<float>(std::min(far, exitOf(o, d, bounds)));
        (perspective_ ? ray.pixel_slope : ray.pixel_radius) = static_cast<float>(0.5 * unit_);
        return ray;
    }

  private:
    static double exitOf(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec4& bounds) {
        if (!std::isfinite(bounds.w)) return INFINITY;
        const glm::dvec3 to_center = glm::dvec3(bounds) - o;
        const double middle = glm::dot(to_center, d);
        const double left = bounds.w * bounds.w - glm::dot(to_center, to_center) + middle * middle;
        return left < 0.0 ? -1.0 : middle + std::sqrt(left);
    }

    bool perspective_;
    glm::dmat4 world_;
    glm::dvec2 center_px_;
    double unit_ = 0.0;  ///< a pixel's side at distance 1; orthographic: anywhere
};

glm::dvec2 positionOf(const FieldWindow& window, std::size_t column, std::size_t row) {
    if (!window.positions_px.empty()) return window.positions_px[row * window.stride() + column];
    return {window.pixels.x0 + (static_cast<double>(column) + 0.5) / window.per_side,
            window.pixels.y0 + (static_cast<double>(row) + 0.5) / window.per_side};
}

}  // namespace

std::vector<GpuRay> raysOf(const MethodInput& input, const FieldWindow& window, std::size_t first_row,
                           std::size_t last_row, double far, const glm::dvec4& bounds) {
    const CameraRays camera(input.camera, input.film);
    const std::size_t stride = window.stride(), tiles_x = (stride + kFieldTile - 1) / kFieldTile,
                      tiles_y = (last_row - first_row + kFieldTile - 1) / kFieldTile;
    std::vector<GpuRay> rays(tiles_x * tiles_y * kFieldTile * kFieldTile);
    for (std::size_t row = first_row; row < last_row; ++row)
        for (std::size_t column = 0; column < stride; ++column)
            rays[rayIndex(column, row - first_row, stride)] =
                camera.at(positionOf(window, column, row), far, bounds);
    return rays;
}

}  // namespace edgewise::vulkan
