#include "pipeline/bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/error.h"
#include "pipeline/weights.h"

namespace edgewise {
namespace {

/// Tiles of weights list the segments that their supports reach: a short segment is in so many lists.
double listsPerSegment(double reach_px) {
    const double side = 1.0 + 2.0 * reach_px / kWeightTilePx;
    return side * side;
}

}  // namespace

void requireLattice(const CellGrid& grid, std::size_t bytes) {
    constexpr std::size_t kBytesOfGather = 2 * sizeof(std::uint32_t) + sizeof(std::size_t);
    if (grid.size() > bytes / kBytesOfGather)
        throw FailureError(
            "--memory", fmt::format("{} x {} cells of {} pixels that the filter reaches need {} MiB",
                                    grid.columns, grid.rows, kCellPx, (grid.size() * kBytesOfGather) >> 20));
}

Bands::Bands(const PixelBox& box, const CellGrid& grid, const IdLists& lists, double reach_px,
             glm::dvec2 offset_px, std::size_t bytes)
    : box_(box),
      last_{box.x0, box.y0, box.x1, box.y0},
      grid_(grid),
      reach_px_(reach_px),
      y_offset_px_(offset_px.y),
      bytes_(static_cast<double>(bytes)),
      bytes_per_piece_(kBytesPerPiece + sizeof(std::uint32_t) * listsPerSegment(reach_px)) {
    for (int row = 0; row <= grid.rows; ++row) pairs_above_.push_back(lists.offsets[grid.index(0, row)]);
    for (int y = box.y0; y < box.y1; y = rowEnd(y)) {
        const double needed = bytesOf(y, rowEnd(y), kLeastPiecesPerPair);
        if (needed > bytes_)
            throw FailureError("--memory", fmt::format("rows {} to {} alone need {:.0f} MiB of buffers", y,
                                                       rowEnd(y), std::ceil(needed / 0x1p20)));
    }
}

int Bands::rowEnd(int y) const {
    return std::min(y + kCellPx, box_.y1);
}

std::size_t Bands::pairs(int y0, int y1) const {
    const auto first = static_cast<std::size_t>(grid_.rowOf(y0 + y_offset_px_ - reach_px_));
    const auto last = static_cast<std::size_t>(grid_.rowOf(y1 + y_offset_px_ + reach_px_));
    return pairs_above_[last + 1] - pairs_above_[first];
}

double Bands::bytesOf(int y0, int y1, double pieces_per_pair) const {
    const int rows =
        grid_.rowOf(y1 + y_offset_px_ + reach_px_) - grid_.rowOf(y0 + y_offset_px_ - reach_px_) + 1;
    return double(pairs(y0, y1)) * (pieces_per_pair * bytes_per_piece_ + sizeof(std::uint32_t)) +
           double(rows) * grid_.columns * kBytesPerCell;
}

std::optional<PixelBox> Bands::next() {
    const int y = last_.y1;
    if (y >= box_.y1) return std::nullopt;
    int end = rowEnd(y);
    while (end < box_.y1 && bytesOf(y, rowEnd(end), pieces_per_pair_) <= bytes_) end = rowEnd(end);
    last_ = {box_.x0, y, box_.x1, end};
    return last_;
}

void Bands::made(std::uint64_t pieces) {
    const std::size_t of = pairs(last_.y0, last_.y1);
    const double reckoned = of == 0 ? 0.0 : 1.5 * double(pieces) / double(of);
    const double before = last_.y0 == box_.y0 ? kLeastPiecesPerPair : pieces_per_pair_;
    pieces_per_pair_ = std::max(before, reckoned);
}

}  // namespace edgewise
