// What the tiles of an area are made of, as lists on the device: the segments within reach, and the owners on
// either side of them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "pipeline/vulkan/id_lists.h"
#include "pipeline/vulkan/layouts.h"
#include "pipeline/vulkan/weight_map.h"

namespace edgewise::vulkan {

#include "shaders/shared/weight_layouts.glsl"

static_assert(sizeof(GpuCarrierLine) == sizeof(CarrierLine) && sizeof(GpuRowOwner) == 16);
static_assert(sizeof(GpuTileSegment) == 16 && sizeof(WeightListPush) == 48);
static_assert(sizeof(GpuPair) == 20 && sizeof(GpuPixelState) == 8 && sizeof(GpuBorderNote) == 32);

/// An area whose boxes are weighed.
struct WeightInput {
    const VisibleMap& map;
    const OwnerClasses& classes;
    PixelBox area;
    glm::dvec2 offset_px{0.0};  ///< whole pixels
    std::shared_ptr<const WeightMap>
        on_device;  ///< all of the map; none: what the area sees of it is put there
};

/// Tiles of kTilePx, row by row from the area's corner. The input's map and classes outlive them.
struct WeightLists {
    WeightInput input;
    std::shared_ptr<const WeightMap> map;
    Buffer offsets;     ///< uint by tile, and the end: twice those into entries
    Buffer entries;     ///< GpuTileSegment: ids of `map`, places among the tile's owners
    Buffer slots;       ///< uint by tile, and the end: into owners
    Buffer owners;      ///< ascending within a tile
    Buffer pair_first;  ///< uint by entry, and the end: pixels that the entries before it may touch
    std::vector<uint> entry_begin, slot_begin, pair_begin;  ///< by tile, and the end
    std::vector<PassTime> times;

    std::size_t columns() const {
        return static_cast<std::size_t>(input.area.width() + kTilePx - 1) / kTilePx;
    }
    /// The tile that begins at a pixel.
    std::size_t tileAt(int x, int y) const {
        return static_cast<std::size_t>((y - input.area.y0) / kTilePx) * columns() +
               static_cast<std::size_t>((x - input.area.x0) / kTilePx);
    }
};

/// Turns that loops may take, some left for what is not counted.
inline std::size_t grantedTurns(const DeviceTraits& traits) {
    return traits.loop_turns - 5000;
}

/// Makes lists: counts, prefix sums, entries; then each tile's owners sorted, and named once.
class WeightListPasses {
  public:
    WeightListPasses(const Device& device, double radius);

    /// nullopt where the area has more than the device is given at once: halve it.
    std::optional<WeightLists> make(const WeightInput& input);

  private:
    struct Job;
    bool reachFits(const Job& job) const;
    bool listsFit(const std::vector<uint>& begin) const;
    void count(Job& job);
    WeightLists list(Job& job, const WeightInput& input, const std::vector<uint>& begin);
    void addCount(PassGraph& graph, const Job& job);
    void addFill(PassGraph& graph, const Job& job);
    void addPlaces(PassGraph& graph, const Job& job);

    const Device& device_;
    const double radius_;
    ComputePass count_, fill_, firsts_, places_;
    Scan scan_;
    ListOrder order_;
};

}  // namespace edgewise::vulkan
