#include "pipeline/vulkan/weight_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "pipeline/vulkan/weight_lists.h"

namespace edgewise::vulkan {
namespace {

GpuCarrierLine packed(const CarrierLine& l) {
    return {l.origin.x, l.origin.y, l.nx_hi,  l.nx_lo,       l.ny_hi,      l.ny_lo,
            l.c_hi,     l.c_lo,     l.length, l.direction.x, l.direction.y};
}

GpuSegment packed(const VisibleSegment& s, uint line, const OwnerClasses& classes) {
    return {{s.a.grid.x, s.a.grid.y},
            {s.a.rest.x, s.a.rest.y},
            {s.b.grid.x, s.b.grid.y},
            {s.b.rest.x, s.b.rest.y},
            s.length,
            line,
            classes.of(s.left),
            classes.of(s.right),
            0};
}

template <class Body>
void forAll(std::size_t count, Body&& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
    });
}

}  // namespace

/// What is taken of a map.
struct WeightMap::Part {
    bool all = true;
    std::vector<std::uint32_t> segments, lines;  ///< ids, ascending, unless it is all
    std::size_t first_row = 0, row_count = 0;

    std::size_t segmentCount(const VisibleMap& map) const {
        return all ? map.segments.size() : segments.size();
    }
    std::size_t lineCount(const VisibleMap& map) const { return all ? map.lines.size() : lines.size(); }
    std::size_t rowOwners(const VisibleMap& map) const {
        return map.row_offset[first_row + row_count] - map.row_offset[first_row];
    }
    uint lineOf(uint line) const {
        if (all) return line;
        return static_cast<uint>(std::lower_bound(lines.begin(), lines.end(), line) - lines.begin());
    }
    bool fits(const Device& device, const VisibleMap& map) const {
        const std::size_t most = device.traits().max_storage_bytes;
        return segmentCount(map) <= most / sizeof(GpuSegment) &&
               lineCount(map) <= most / sizeof(GpuCarrierLine) &&
               rowOwners(map) <= most / sizeof(GpuRowOwner) && row_count < most / sizeof(uint);
    }
};

std::optional<WeightMap> WeightMap::ofAll(const Device& device, const VisibleMap& map,
                                          const OwnerClasses& classes) {
    Part part;
    part.row_count = map.row_offset.size() - 1;
    if (!part.fits(device, map)) return std::nullopt;
    return WeightMap(device, map, classes, part);
}

std::optional<WeightMap> WeightMap::around(const Device& device, const VisibleMap& map,
                                           const OwnerClasses& classes, const PixelBox& box,
                                           glm::dvec2 offset_px, double radius) {
    // one tile that holds the whole tiles of the box
    const int side = (std::max(box.width(), box.height()) + kTilePx - 1) / kTilePx * kTilePx;
    Part part;
    part.all = false;
    part.segments = gatherSegments(map, box, offset_px, radius, side).segments.ids;
    std::ranges::sort(part.segments);
    for (const std::uint32_t id : part.segments) part.lines.push_back(map.segments[id].line);
    std::ranges::sort(part.lines);
    part.lines.erase(std::unique(part.lines.begin(), part.lines.end()), part.lines.end());
    part.first_row = static_cast<std::size_t>(box.y0 + static_cast<int>(offset_px.y) - map.row_begin);
    part.row_count = static_cast<std::size_t>(box.height());
    if (!part.fits(device, map)) return std::nullopt;
    return WeightMap(device, map, classes, part);
}

WeightMap::WeightMap(const Device& device, const VisibleMap& map, const OwnerClasses& classes,
                     const Part& part)
    : ids_(part.segments),
      size_(part.segmentCount(map)),
      row_begin_(map.row_begin + static_cast<int>(part.first_row)),
      segments_(device, "segments", size_ * sizeof(GpuSegment)),
      lines_(device, "lines", part.lineCount(map) * sizeof(GpuCarrierLine)),
      row_offsets_(device, "row offsets", (part.row_count + 1) * sizeof(uint)),
      rows_(device, "rows", part.rowOwners(map) * sizeof(GpuRowOwner)) {
    const auto segments = segments_.view<GpuSegment>(size_);
    forAll(size_, [&](std::size_t i) {
        const VisibleSegment& s = map.segments[segment(i)];
        segments[i] = packed(s, part.lineOf(s.line), classes);
    });
    const auto lines = lines_.view<GpuCarrierLine>(part.lineCount(map));
    forAll(lines.size(), [&](std::size_t i) { lines[i] = packed(map.lines[part.all ? i : part.lines[i]]); });
    const std::size_t first = map.row_offset[part.first_row];
    const auto offsets = row_offsets_.view<uint>(part.row_count + 1);
    for (std::size_t row = 0; row < offsets.size(); ++row)
        offsets[row] = static_cast<uint>(map.row_offset[part.first_row + row] - first);
    const auto rows = rows_.view<GpuRowOwner>(part.rowOwners(map));
    forAll(rows.size(), [&](std::size_t i) {
        rows[i] = {map.rows[first + i].x_px, classes.of(map.rows[first + i].owner), 0};
    });
}

}  // namespace edgewise::vulkan
