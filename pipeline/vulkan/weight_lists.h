// What a box's tiles are made of: the segments within reach, and the owners on either side of them.
#pragma once

#include <vector>

#include "pipeline/vulkan/layouts.h"
#include "pipeline/vulkan/weights.h"

namespace edgewise::vulkan {

#include "shaders/shared/weight_layouts.glsl"

static_assert(sizeof(GpuCarrierLine) == sizeof(CarrierLine) && sizeof(GpuRowOwner) == 16);
static_assert(sizeof(GpuPixelState) == 96);

struct WeightLists {
    WeightLists(const WeightInput& input, double radius);

    WeightTiles tiles;  ///< of kTilePx, with ids of the map's segments
    std::vector<GpuSegment> segments;
    std::vector<GpuCarrierLine> lines;
    std::vector<uint> offsets, slots;  ///< by tile, and the end: into entries, into owners
    std::vector<GpuTileSegment> entries;
    std::vector<uint> owners;  ///< ascending within a tile
    std::vector<uint> row_offsets;
    std::vector<GpuRowOwner> rows;
    std::size_t longest = 0;  ///< entries of a tile
};

}  // namespace edgewise::vulkan
