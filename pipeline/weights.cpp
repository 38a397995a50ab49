#include "pipeline/weights.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "analytic/edge_input.h"
#include "analytic/row_owners.h"
#include "analytic/segment_tiles.h"

namespace edgewise {
namespace {

using f64::kReachSlackPx;

glm::dvec2 rounded(const FinePoint& p) {
    return p.grid + p.rest;
}

f64::Span spanWithin(glm::dvec2 a, glm::dvec2 b, double y0, double y1) {
    return f64::spanWithin(a.x, a.y, b.x, b.y, y0, y1);
}

template <class Item>
void fetch(const Item& item) {
    const char* begin = reinterpret_cast<const char*>(&item);
    for (std::size_t at = 0; at < sizeof(Item); at += 64) __builtin_prefetch(begin + at);
    __builtin_prefetch(begin + sizeof(Item) - 1);
}

/// Segments that end in a tile begin in other cells, and lie there in the map, their lines elsewhere: both
/// are asked for before their turn.
void fetchAhead(const VisibleMap& map, std::span<const std::uint32_t> segments, std::size_t k) {
    constexpr std::size_t kSegmentAhead = 16, kLineAhead = 8;
    if (k + kSegmentAhead < segments.size()) fetch(map.segments[segments[k + kSegmentAhead]]);
    if (k + kLineAhead < segments.size()) fetch(map.lines[map.segments[segments[k + kLineAhead]].line]);
}

/// The lattice of weight tiles over a box of pixels.
struct TileLattice {
    PixelBox box;
    int side_px, columns, rows;

    TileLattice(const PixelBox& pixels, int tile_px) : box(pixels), side_px(tile_px) {
        columns = (box.width() + side_px - 1) / side_px;
        rows = (box.height() + side_px - 1) / side_px;
    }
    PixelBox tile(int column, int row) const {
        const int x = box.x0 + column * side_px, y = box.y0 + row * side_px;
        return {x, y, std::min(x + side_px, box.x1), std::min(y + side_px, box.y1)};
    }
};

template <class Visit>
void forTilesOf(const VisibleSegment& s, const TileLattice& lattice, glm::dvec2 offset_px, double radius,
                Visit&& visit) {
    const glm::dvec2 a = rounded(s.a) - offset_px, b = rounded(s.b) - offset_px;
    const double reach = radius + kReachSlackPx;
    const auto [r0, r1] =
        f64::tileSpan(a.y - reach, b.y + reach, lattice.box.y0, lattice.side_px, lattice.rows);
    for (int row = r0; row <= r1; ++row) {
        const double y0 = lattice.box.y0 + row * lattice.side_px;
        const f64::Span x = spanWithin(a, b, y0 - reach, y0 + lattice.side_px + reach);
        if (x.low > x.high) continue;
        const auto [c0, c1] =
            f64::tileSpan(x.low - reach, x.high + reach, lattice.box.x0, lattice.side_px, lattice.columns);
        for (int column = c0; column <= c1; ++column)
            visit(static_cast<std::size_t>(row) * lattice.columns + static_cast<std::size_t>(column));
    }
}

}  // namespace

OwnerClasses OwnerClasses::ofMap(const LayerStacks& stacks, LayerStacks& named) const {
    OwnerClasses out{representative, {}};
    LayerStacks unsorted;
    std::vector<Owner> layers;
    for (std::size_t i = 0; i < stacks.size(); ++i) {
        layers.clear();
        for (const Owner layer : stacks.layers(static_cast<Owner>(kFirstStack + i)))
            layers.push_back(of(layer));
        out.stack_name.push_back(unsorted.owner(layers));
    }
    const LayerStacks* const parts[] = {&unsorted};
    std::vector<std::vector<Owner>> names;
    named = LayerStacks::joined(parts, names);
    for (Owner& name : out.stack_name) name = names[0][name - kFirstStack];
    return out;
}

WeightTiles gatherSegments(const VisibleMap& map, const PixelBox& box, glm::dvec2 offset_px, double radius,
                           int tile_px) {
    const TileLattice lattice(box, tile_px);
    WeightTiles tiles;
    for (int row = 0; row < lattice.rows; ++row)
        for (int column = 0; column < lattice.columns; ++column)
            tiles.boxes.push_back(lattice.tile(column, row));
    std::vector<std::atomic<std::uint32_t>> histogram(tiles.boxes.size());
    const auto forSegments = [&](auto&& visit) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, map.segments.size(), 1024),
                          [&](const auto& range) {
                              for (std::size_t i = range.begin(); i < range.end(); ++i)
                                  forTilesOf(map.segments[i], lattice, offset_px, radius,
                                             [&](std::size_t tile) { visit(tile, i); });
                          });
    };
    forSegments(
        [&](std::size_t tile, std::size_t) { histogram[tile].fetch_add(1, std::memory_order_relaxed); });
    std::vector<std::uint32_t> counts(histogram.size());
    for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] = histogram[i].exchange(0, std::memory_order_relaxed);
    tiles.segments.offsets = offsetsFromCounts(counts);
    tiles.segments.ids.resize(tiles.segments.offsets.back());
    forSegments([&](std::size_t tile, std::size_t i) {
        const std::size_t slot = histogram[tile].fetch_add(1, std::memory_order_relaxed);
        tiles.segments.ids[tiles.segments.offsets[tile] + slot] = static_cast<std::uint32_t>(i);
    });
    return tiles;
}

WeightWorker::WeightWorker(const Prefilter& filter, const WeightOptions& options)
    : radius_(filter.radius),
      options_(options),
      weights_(filter, options.precision),
      points_(filter, options.shading) {}

/// Each segment is read once a tile and noted in the rows that it comes near.
void WeightWorker::collectRows(const VisibleMap& map, std::span<const std::uint32_t> segments,
                               const OwnerClasses& classes, const PixelBox& box, double offset_y_px) {
    const int height = box.height();
    if (rows_.size() < static_cast<std::size_t>(height)) rows_.resize(static_cast<std::size_t>(height));
    for (std::vector<Span>& row : rows_) row.clear();
    edges_.clear();
    const double reach = radius_ + kReachSlackPx, first_y = box.y0 + 0.5 + offset_y_px;
    for (std::size_t k = 0; k < segments.size(); ++k) {
        fetchAhead(map, segments, k);
        const std::uint32_t id = segments[k];
        const VisibleSegment& s = map.segments[id];
        const Owner left = classes.of(s.left), right = classes.of(s.right);
        if (left == right && options_.skip_cancelling) continue;
        const glm::dvec2 a = rounded(s.a), b = rounded(s.b);
        // A row more on either side, for rounding: the comparison below decides.
        const double last = height - 1.0;
        const int begin = static_cast<int>(std::clamp(a.y - reach - first_y - 1.0, 0.0, last));
        const int end = static_cast<int>(std::clamp(b.y + reach - first_y + 1.0, 0.0, last));
        const double slope = f64::slopeOf(a.x, a.y, b.x, b.y);
        const auto index = static_cast<std::uint32_t>(edges_.size());
        edges_.push_back({edgeInput(s, map.lines[s.line]), id, left, right});
        for (int row = begin; row <= end; ++row) {
            const double y = first_y + row;
            if (a.y > y + reach || b.y < y - reach) continue;
            const auto [x0, x1] = f64::spanAlong(a.x, a.y, b.x, b.y, slope, y - reach, y + reach);
            rows_[static_cast<std::size_t>(row)].push_back({index, x0 - reach, x1 + reach});
        }
    }
}

void WeightWorker::beginGroup(glm::dvec2 first, int count) {
    weights_.begin(first, count);
    if (points_.active()) points_.begin(first, count);
}

void WeightWorker::runGroup(const VisibleMap& map, const OwnerClasses& classes, std::span<const Span> spans,
                            glm::dvec2 first, int row, int count, const Owner* base, WeightTile& out) {
    std::uint64_t met = 0;  // samples whose support a segment may touch
    for (const Span& span : spans) {
        const LaneRange lanes = LaneRange::within(span.x0 - first.x, span.x1 - first.x, count);
        if (lanes.last < lanes.first) continue;
        if (met == 0) beginGroup(first, count);
        met |= (std::uint64_t{2} << lanes.last) - (std::uint64_t{1} << lanes.first);
        const Edge& edge = edges_[span.edge];
        weights_.add(edge.input, edge.left, edge.right, lanes);
        if (!points_.active()) continue;
        const VisibleSegment& s = map.segments[edge.segment];
        points_.add(s, map.lines[s.line], edge.left, edge.right);
    }
    if (options_.skip_interior) interior_pixels_ += static_cast<std::uint64_t>(count - std::popcount(met));
    if (met == 0 && options_.skip_interior) {
        for (int k = 0; k < count; ++k) {
            out.entries.push_back({base[k], FixedWeight{1} << kWeightBits});
            out.offset.push_back(out.entries.size());
            if (points_.active()) points_.whole(out.points);
        }
        return;
    }
    if (met == 0) beginGroup(first, count);
    std::size_t offset[PixelWeights::kLanes + 1];
    weights_.finish(base, out.entries, offset);
    for (int k = 0; k < count; ++k) out.offset.push_back(offset[k + 1]);
    if (!points_.active()) return;
    const auto owner_right_of = [&](double x_px) { return classes.of(ownerOnRow(map, row, x_px)); };
    points_.finish(base, owner_right_of, out.entries, offset, out.points);
}

void WeightWorker::run(const VisibleMap& map, std::span<const std::uint32_t> segments,
                       const OwnerClasses& classes, const PixelBox& box, glm::dvec2 offset_px,
                       WeightTile& out) {
    out.box = box;
    out.offset.assign(1, 0);
    out.entries.clear();
    out.points.clear();
    collectRows(map, segments, classes, box, offset_px.y);
    Owner base[PixelWeights::kLanes];
    const int group = points_.active() ? ShadingPointFinder::kLanes : PixelWeights::kLanes;
    for (int y = box.y0; y < box.y1; ++y) {
        const double sample_y = y + 0.5 + offset_px.y;
        for (int x = box.x0; x < box.x1; x += group) {
            const int count = std::min(group, box.x1 - x);
            const glm::dvec2 first(x + 0.5 + offset_px.x, sample_y);
            const int row = y + static_cast<int>(offset_px.y);
            Owner last = kBackground, last_class = kBackground;
            ownersAlongRow(map, row, first.x + radius_, count, [&](int k, Owner o) {
                if (o != last) last = o, last_class = classes.of(o);
                base[k] = last_class;
            });
            runGroup(map, classes, rows_[static_cast<std::size_t>(y - box.y0)], first, row, count, base, out);
        }
    }
}

}  // namespace edgewise
