// The rays of a window's samples, in tiles of 8 x 8 for the device.
#pragma once

#include <vector>

#include "pipeline/field_tracer.h"
#include "sdf/ray_grid.h"
#include "sdf/surface_light.h"

namespace edgewise::vulkan {

inline constexpr std::size_t kFieldTile = 8;

/// Where a sample's ray lies among those of `rows` rows of samples, `stride` a row: tile by tile, row by row.
inline std::size_t rayIndex(std::size_t column, std::size_t row, std::size_t stride) {
    const std::size_t tiles = (stride + kFieldTile - 1) / kFieldTile;
    return ((row / kFieldTile) * tiles + column / kFieldTile) * kFieldTile * kFieldTile +
           row % kFieldTile * kFieldTile + column % kFieldTile;
}

/// The rays of sample rows [first_row, last_row); samples beyond the window have rays without a length.
std::vector<sdf::TravellingRay> raysOf(const sdf::RayGrid& grid, const FieldWindow& window,
                                       std::size_t first_row, std::size_t last_row, double sign);

}  // namespace edgewise::vulkan
