#include "pipeline/vulkan/weight_lists.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace edgewise::vulkan {
namespace {

constexpr uint kUnused = 0xffffffffu;

GpuCarrierLine packed(const CarrierLine& l) {
    return {l.origin.x, l.origin.y, l.nx_hi,  l.nx_lo,       l.ny_hi,      l.ny_lo,
            l.c_hi,     l.c_lo,     l.length, l.direction.x, l.direction.y};
}

GpuSegment packed(const VisibleSegment& s, uint line) {
    return {{s.a.grid.x, s.a.grid.y},
            {s.a.rest.x, s.a.rest.y},
            {s.b.grid.x, s.b.grid.y},
            {s.b.rest.x, s.b.rest.y},
            s.length,
            line,
            s.left,
            s.right,
            0};
}

/// One tile's part, before it has its place.
struct TilePart {
    std::vector<GpuTileSegment> entries;
    std::vector<uint> owners;
};

class TileParts {
  public:
    TileParts(const WeightInput& input, const WeightTiles& tiles)
        : input_(input), tiles_(tiles), parts_(tiles.boxes.size()) {
        tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t t) { fill(t); });
    }
    std::vector<TilePart>& all() { return parts_; }

  private:
    /// Entries hold owners at first, then their places.
    void fill(std::size_t t) {
        TilePart& part = parts_[t];
        for (std::size_t k = tiles_.segments.offsets[t]; k < tiles_.segments.offsets[t + 1]; ++k) {
            const uint id = tiles_.segments.ids[k];
            const VisibleSegment& s = input_.map.segments[id];
            const Owner left = input_.classes.of(s.left), right = input_.classes.of(s.right);
            if (left == right) continue;  // no border between owners that are one
            part.entries.push_back({id, left, right});
            part.owners.push_back(left), part.owners.push_back(right);
        }
        std::sort(part.owners.begin(), part.owners.end());
        part.owners.erase(std::unique(part.owners.begin(), part.owners.end()), part.owners.end());
        const auto placeOf = [&](uint owner) {
            return static_cast<uint>(std::lower_bound(part.owners.begin(), part.owners.end(), owner) -
                                     part.owners.begin());
        };
        for (GpuTileSegment& entry : part.entries)
            entry.left = placeOf(entry.left), entry.right = placeOf(entry.right);
    }

    const WeightInput& input_;
    const WeightTiles& tiles_;
    std::vector<TilePart> parts_;
};

/// Numbers what is used in the order of its first use.
class Renumbering {
  public:
    explicit Renumbering(std::size_t count) : number_(count, kUnused) {}
    template <class Add>
    uint of(std::size_t old, uint next, Add&& add) {
        if (number_[old] == kUnused) number_[old] = next, add();
        return number_[old];
    }

  private:
    std::vector<uint> number_;
};

}  // namespace

WeightLists::WeightLists(const WeightInput& input, double radius)
    : tiles(gatherSegments(input.map, input.box, input.offset_px, radius, kTilePx)) {
    TileParts parts(input, tiles);
    Renumbering segment_number(input.map.segments.size()), line_number(input.map.lines.size());
    offsets.push_back(0), slots.push_back(0);
    for (TilePart& part : parts.all()) {
        for (GpuTileSegment& entry : part.entries) {
            const VisibleSegment& s = input.map.segments[entry.segment];
            entry.segment = segment_number.of(entry.segment, static_cast<uint>(segments.size()), [&] {
                const uint line = line_number.of(s.line, static_cast<uint>(lines.size()),
                                                 [&] { lines.push_back(packed(input.map.lines[s.line])); });
                segments.push_back(packed(s, line));
            });
        }
        longest = std::max(longest, part.entries.size());
        entries.insert(entries.end(), part.entries.begin(), part.entries.end());
        owners.insert(owners.end(), part.owners.begin(), part.owners.end());
        offsets.push_back(static_cast<uint>(entries.size()));
        slots.push_back(static_cast<uint>(owners.size()));
        part = {};
    }
    const VisibleMap& map = input.map;
    const int first_row = input.box.y0 + static_cast<int>(input.offset_px.y) - map.row_begin;
    row_offsets.push_back(0);
    for (int row = first_row; row < first_row + input.box.height(); ++row) {
        for (std::size_t i = map.row_offset[static_cast<std::size_t>(row)];
             i < map.row_offset[static_cast<std::size_t>(row) + 1]; ++i)
            rows.push_back({map.rows[i].x_px, input.classes.of(map.rows[i].owner), 0});
        row_offsets.push_back(static_cast<uint>(rows.size()));
    }
}

}  // namespace edgewise::vulkan
