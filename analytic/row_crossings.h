// Where the sample rows of a cell meet its visible segments: the owners along them.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "analytic/cell_clip.h"

namespace edgewise {

class RowCrossings {
  public:
    void clear() { crossings_.clear(); }

    /// Of the part of a line from `start` down to `end` inside the cell, with its owners.
    void add(const CellFrame& frame, const LeafLine& line, const FinePoint& start, const FinePoint& end,
             Owner left, Owner right) {
        const OrderKey from = frame.key(yOf(start)), to = frame.key(yOf(end));
        for (int row = static_cast<int>(std::floor(start.grid.y - 0.5)); row + 0.5 <= end.grid.y; ++row) {
            const FineCoordinate y{row + 0.5, 0.0};
            const OrderKey key = orderKey(y, frame.origin.y);
            if (key < from || key >= to) continue;
            crossings_.push_back({row, frame.origin.x + line.xAt(frame, y), line.slope, left, right});
        }
    }

    /// From left to right on each row. False where labels do not chain: rounding exchanged the ends of a thin
    /// owner.
    bool sort() {
        std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
            return std::tie(a.row, a.x, a.slope) < std::tie(b.row, b.x, b.slope);
        });
        for (std::size_t k = 0; k + 1 < crossings_.size(); ++k) {
            const Crossing &a = crossings_[k], &b = crossings_[k + 1];
            if (a.row == b.row && a.after != b.before) return false;
        }
        return true;
    }

    /// A row starts with the left owner of its first crossing; without one, with `ownerAt` its middle.
    template <class OwnerAt>
    void emit(const Cell& cell, const OwnerAt& ownerAt, std::vector<RowPiece>& out) const {
        const double start = cell.min.x + kBorderRestPx, middle = 0.5 * (cell.min.x + cell.max.x);
        auto next = crossings_.begin();
        for (int row = static_cast<int>(std::floor(cell.min.y - 0.5)); row + 0.5 <= cell.max.y; ++row) {
            if (!(row + 0.5 > cell.min.y)) continue;
            if (next == crossings_.end() || next->row != row) {
                out.push_back({row, ownerAt(glm::dvec2(middle, row + 0.5)), start});
                continue;
            }
            out.push_back({row, next->before, start});
            for (; next != crossings_.end() && next->row == row; ++next)
                out.push_back({row, next->after, next->x});
        }
    }

  private:
    /// A row meets a segment that is not horizontal at x; right of it lies `after`. Segments that leave one
    /// point on the row are in the order in which the scanline just below meets them: by slope.
    struct Crossing {
        int row;
        double x, slope;
        Owner before, after;
    };
    std::vector<Crossing> crossings_;
};

}  // namespace edgewise
