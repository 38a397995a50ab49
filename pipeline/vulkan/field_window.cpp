#include "pipeline/vulkan/field_window.h"

#include <tbb/parallel_for.h>

namespace edgewise::vulkan {
namespace {

glm::dvec2 positionOf(const FieldWindow& window, std::size_t column, std::size_t row) {
    if (!window.positions_px.empty()) return window.positions_px[row * window.stride() + column];
    return {window.pixels.x0 + (static_cast<double>(column) + 0.5) / window.per_side,
            window.pixels.y0 + (static_cast<double>(row) + 0.5) / window.per_side};
}

}  // namespace

std::vector<sdf::TravellingRay> raysOf(const sdf::RayGrid& grid, const FieldWindow& window,
                                       std::size_t first_row, std::size_t last_row, double sign) {
    const std::size_t stride = window.stride(), tiles_x = (stride + kFieldTile - 1) / kFieldTile,
                      tiles_y = (last_row - first_row + kFieldTile - 1) / kFieldTile;
    sdf::TravellingRay none;
    none.ray.t_max = -1.0;
    std::vector<sdf::TravellingRay> rays(tiles_x * tiles_y * kFieldTile * kFieldTile, none);
    tbb::parallel_for(first_row, last_row, [&](std::size_t row) {
        for (std::size_t column = 0; column < stride; ++column)
            rays[rayIndex(column, row - first_row, stride)] = {grid.ray(positionOf(window, column, row)),
                                                               sign};
    });
    return rays;
}

}  // namespace edgewise::vulkan
