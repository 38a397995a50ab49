// The rays of a window's samples, in tiles of 8 x 8 for the device.
#pragma once

#include <vector>

#include "pipeline/field_tracer.h"
#include "pipeline/vulkan/field_rays.h"

namespace edgewise::vulkan {

inline constexpr std::size_t kFieldTile = 8;

/// Where a sample's ray lies among those of `rows` rows of samples, `stride` a row: tile by tile, row by row.
inline std::size_t rayIndex(std::size_t column, std::size_t row, std::size_t stride) {
    const std::size_t tiles = (stride + kFieldTile - 1) / kFieldTile;
    return ((row / kFieldTile) * tiles + column / kFieldTile) * kFieldTile * kFieldTile +
           row % kFieldTile * kFieldTile + column % kFieldTile;
}

/// The rays of sample rows [first_row, last_row); samples beyond the window trace nothing. A ray ends at
/// `far` and where it leaves `bounds` (a sphere), or at once where it misses that.
std::vector<GpuRay> raysOf(const MethodInput& input, const FieldWindow& window, std::size_t first_row,
                           std::size_t last_row, double far, const glm::dvec4& bounds);

}  // namespace edgewise::vulkan
