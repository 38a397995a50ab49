#include "pipeline/merge_map.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <memory>

#include "pipeline/error.h"

namespace edgewise {
namespace {

constexpr std::size_t kPiecesPerChunk = 4096;

/// Memory that is written before it is read: a vector would be filled by one thread first.
template <class Item>
class Unfilled {
  public:
    explicit Unfilled(std::size_t size)
        : bytes_(std::make_unique_for_overwrite<std::byte[]>(size * sizeof(Item))), size_(size) {
        static_assert(std::is_trivially_copyable_v<Item> &&
                      alignof(Item) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);
    }
    std::span<Item> items() { return {reinterpret_cast<Item*>(bytes_.get()), size_}; }

  private:
    std::unique_ptr<std::byte[]> bytes_;
    std::size_t size_;
};

/// The outputs' segments, one output behind the other.
Unfilled<SegmentPiece> takeSegments(std::span<CellOutput* const> outputs) {
    std::vector<std::size_t> begin{0};
    for (const CellOutput* out : outputs) begin.push_back(begin.back() + out->segments.size());
    Unfilled<SegmentPiece> all(begin.back());
    tbb::parallel_for(std::size_t{0}, outputs.size(), [&](std::size_t i) {
        std::vector<SegmentPiece>& pieces = outputs[i]->segments;
        std::ranges::copy(pieces, all.items().begin() + static_cast<std::ptrdiff_t>(begin[i]));
        std::vector<SegmentPiece>().swap(pieces);
    });
    return all;
}

/// Where to cut sorted pieces so that a line's lie in one chunk.
std::vector<std::size_t> chunksOf(std::span<const SegmentPiece> pieces) {
    std::vector<std::size_t> cuts{0};
    while (cuts.back() < pieces.size()) {
        std::size_t cut = std::min(cuts.back() + kPiecesPerChunk, pieces.size());
        while (cut < pieces.size() && pieces[cut].key == pieces[cut - 1].key) ++cut;
        cuts.push_back(cut);
    }
    return cuts;
}

void mergeSegments(const ScreenScene& scene, std::span<const SegmentPiece> pieces, VisibleMap& map) {
    const std::vector<std::size_t> cuts = chunksOf(pieces);
    const std::size_t chunks = cuts.size() - 1;
    const auto chunk = [&](std::size_t i) { return pieces.subspan(cuts[i], cuts[i + 1] - cuts[i]); };
    std::vector<MergedCounts> before(chunks + 1);
    tbb::parallel_for(std::size_t{0}, chunks,
                      [&](std::size_t i) { before[i + 1] = countMerged(scene, chunk(i)); });
    for (std::size_t i = 0; i < chunks; ++i)
        before[i + 1].lines += before[i].lines, before[i + 1].segments += before[i].segments;
    map.lines.resize(before[chunks].lines);
    map.segments.resize(before[chunks].segments);
    tbb::parallel_for(std::size_t{0}, chunks,
                      [&](std::size_t i) { mergeInto(scene, chunk(i), before[i], map.lines, map.segments); });
}

/// Pieces by row, those of one row in the outputs' order.
class RowBuckets {
  public:
    RowBuckets(std::span<CellOutput* const> outputs, int row_begin, int row_end)
        : row_begin_(row_begin),
          rows_(static_cast<std::size_t>(std::max(0, row_end - row_begin))),
          next_(outputs.size() * rows_, 0),
          begin_(rows_ + 1, 0),
          items_(countAll(outputs)) {
        tbb::parallel_for(std::size_t{0}, outputs.size(), [&](std::size_t o) { scatter(*outputs[o], o); });
    }

    std::size_t rows() const { return rows_; }
    std::span<RowOwner> row(std::size_t r) {
        return items_.items().subspan(begin_[r], begin_[r + 1] - begin_[r]);
    }

  private:
    template <class Visit>
    void eachInside(const CellOutput& out, const Visit& visit) const {
        for (const RowPiece& p : out.rows) {
            const auto r = static_cast<std::size_t>(p.row - row_begin_);  // far beyond where above the first
            if (r < rows_) visit(p, r);
        }
    }

    /// Fills begin_ and next_.
    std::size_t countAll(std::span<CellOutput* const> outputs) {
        tbb::parallel_for(std::size_t{0}, outputs.size(), [&](std::size_t o) {
            eachInside(*outputs[o], [&](const RowPiece&, std::size_t r) { ++next_[o * rows_ + r]; });
        });
        std::size_t sum = 0;
        for (std::size_t r = 0; r < rows_; ++r) {
            begin_[r] = sum;
            for (std::size_t o = 0; o < outputs.size(); ++o) {
                const std::size_t count = next_[o * rows_ + r];
                next_[o * rows_ + r] = sum;
                sum += count;
            }
        }
        begin_[rows_] = sum;
        return sum;
    }

    void scatter(CellOutput& out, std::size_t o) {
        eachInside(out, [&](const RowPiece& p, std::size_t r) {
            items_.items()[next_[o * rows_ + r]++] = {p.x_px, p.owner};
        });
        std::vector<RowPiece>().swap(out.rows);
    }

    int row_begin_;
    std::size_t rows_;
    std::vector<std::size_t> next_;   ///< by output, then row
    std::vector<std::size_t> begin_;  ///< by row
    Unfilled<RowOwner> items_;
};

void mergeAllRows(std::span<CellOutput* const> outputs, int row_begin, int row_end, VisibleMap& map) {
    RowBuckets buckets(outputs, row_begin, row_end);
    map.row_begin = row_begin;
    map.row_offset.assign(buckets.rows() + 1, 0);
    tbb::parallel_for(std::size_t{0}, buckets.rows(),
                      [&](std::size_t r) { map.row_offset[r + 1] = joinRow(buckets.row(r)); });
    for (std::size_t r = 0; r < buckets.rows(); ++r) map.row_offset[r + 1] += map.row_offset[r];
    map.rows.resize(map.row_offset.back());
    tbb::parallel_for(std::size_t{0}, buckets.rows(), [&](std::size_t r) {
        const auto count = static_cast<std::ptrdiff_t>(map.row_offset[r + 1] - map.row_offset[r]);
        std::copy_n(buckets.row(r).begin(), count,
                    map.rows.begin() + static_cast<std::ptrdiff_t>(map.row_offset[r]));
    });
}

}  // namespace

VisibleMap mergeMap(const ScreenScene& scene, std::span<CellOutput* const> outputs, int row_begin,
                    int row_end, Progress& progress) {
    VisibleMap map;
    map.stacks = joinStacks(outputs);
    {
        Unfilled<SegmentPiece> pieces = takeSegments(outputs);
        if (progress.cancelled()) throw Interrupted();
        tbb::parallel_sort(pieces.items().begin(), pieces.items().end(), pieceBefore);
        mergeSegments(scene, pieces.items(), map);
    }
    mergeAllRows(outputs, row_begin, row_end, map);
    return map;
}

}  // namespace edgewise
