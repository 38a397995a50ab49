// A picture's weights by the CPU and by the device, entry by entry.
#pragma once

#include "pipeline/gather.h"
#include "pipeline/methods/nsaa_frame.h"
#include "pipeline/visibility.h"
#include "pipeline/vulkan/weights.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan::test {

struct WeightComparison {
    std::size_t pixels = 0, entries = 0;
    std::size_t differing = 0;  ///< pixels with other owners, or a weight with other bits
    std::size_t handed = 0;     ///< pixels that the device left to the host
    std::uint64_t terms = 0, device_terms = 0;
    double worst = 0.0;  ///< difference of a weight from the CPU's in fp64
};

/// The CPU's visible map, and weights of it by both.
class DeviceWeighing final : public NsaaStages {
  public:
    WeightComparison found;

    VisibleMap visibleMap(NsaaFrame& frame, const CellGrid& grid) override {
        return visibility(frame.screen, grid, gather(frame.screen, grid), frame.plan.visibility,
                          frame.in.progress, frame.visibility_counts);
    }
    WeightTile weights(NsaaFrame& frame, const VisibleMap& map, const OwnerClasses& classes,
                       const PixelBox& box) override {
        return onHost(frame, map, classes, box, frame.plan.weights.precision);
    }
    void render(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                const PixelBox& band) override {
        if (!weights_) weights_.emplace(device(), frame.in.filter, frame.plan.weights);
        auto all = WeightMap::ofAll(device(), map, owners.alike.classes);
        ASSERT_TRUE(all) << "a map that does not fit";
        const WeightInput input{map, owners.alike.classes, band, frame.offset(),
                                std::make_shared<const WeightMap>(std::move(*all))};
        const auto lists = weights_->listsOf(input);
        ASSERT_TRUE(lists) << "a band that does not fit";
        for (int y = band.y0; y < band.y1; y += kWeightTilePx)
            for (int x = band.x0; x < band.x1; x += kWeightTilePx)
                compare(frame, *lists,
                        {x, y, std::min(x + kWeightTilePx, band.x1), std::min(y + kWeightTilePx, band.y1)});
        found.handed = weights_->report().handed;
        found.device_terms = weights_->report().terms;
    }

  private:
    WeightTile onHost(NsaaFrame& frame, const VisibleMap& map, const OwnerClasses& classes,
                      const PixelBox& box, Precision precision) {
        const WeightTiles tiles = gatherSegments(map, box, frame.offset(), frame.in.filter.radius);
        WeightOptions options = frame.plan.weights;
        options.precision = precision;
        WeightWorker worker(frame.in.filter, options);
        WeightTile tile;
        worker.run(map, tiles.segments.ids, classes, box, frame.offset(), tile);
        found.terms += worker.terms();
        return tile;
    }

    /// Boxes take turns: the band's lists and map, or those of the box alone.
    void compare(NsaaFrame& frame, const WeightLists& of_band, const PixelBox& box) {
        const VisibleMap& map = of_band.input.map;
        const OwnerClasses& classes = of_band.input.classes;
        const bool alone = boxes_++ % 2 == 1;
        const auto of_box = alone ? weights_->listsOf({map, classes, box, frame.offset(), {}}) : std::nullopt;
        ASSERT_EQ(alone, of_box.has_value());
        PassGraph graph(device());
        const auto entries = weights_->addTo(graph, of_box ? *of_box : of_band, box);
        ASSERT_TRUE(entries) << "a tile that does not fit";
        graph.run({entries->offsets, entries->owners, entries->weights});
        const auto pixels = static_cast<std::size_t>(box.width()) * box.height();
        const auto offsets = graph[entries->offsets].read<std::uint32_t>(pixels + 1);
        const auto owners = graph[entries->owners].read<std::uint32_t>(offsets[pixels]);
        const auto weights = graph[entries->weights].read<FixedWeight>(offsets[pixels]);
        const WeightTile tile = onHost(frame, map, classes, box, frame.plan.weights.precision);
        for (std::size_t p = 0; p < pixels; ++p) {
            bool equal = offsets[p + 1] - offsets[p] == tile.offset[p + 1] - tile.offset[p];
            for (std::size_t e = offsets[p], h = tile.offset[p]; equal && e < offsets[p + 1]; ++e, ++h)
                equal = owners[e] == tile.entries[h].owner && weights[e] == tile.entries[h].weight;
            found.differing += !equal;
        }
        found.pixels += pixels, found.entries += owners.size();
        if (frame.plan.weights.precision == Precision::kFp32) noteWorst(frame, map, classes, box, tile);
    }

    void noteWorst(NsaaFrame& frame, const VisibleMap& map, const OwnerClasses& classes, const PixelBox& box,
                   const WeightTile& tile) {
        const std::uint64_t terms = found.terms;
        const WeightTile exact = onHost(frame, map, classes, box, Precision::kFp64);
        found.terms = terms;
        for (std::size_t p = 0; p + 1 < tile.offset.size(); ++p) {
            std::map<Owner, FixedWeight> off;
            for (std::size_t e = exact.offset[p]; e < exact.offset[p + 1]; ++e)
                off[exact.entries[e].owner] += exact.entries[e].weight;
            for (std::size_t e = tile.offset[p]; e < tile.offset[p + 1]; ++e)
                off[tile.entries[e].owner] -= tile.entries[e].weight;
            for (const auto& [owner, difference] : off)
                found.worst = std::max(found.worst,
                                       std::abs(std::ldexp(static_cast<double>(difference), -kWeightBits)));
        }
    }

    std::optional<WeightPasses> weights_;
    std::size_t boxes_ = 0;
};

inline WeightComparison compareWeights(const MethodInput& input) {
    DeviceWeighing stages;
    NsaaFrame(input).render(stages);
    return stages.found;
}

}  // namespace edgewise::vulkan::test
