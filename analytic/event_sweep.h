// Visibility of a leaf by its events alone: where two lines cross, or lines begin or end, the order of the
// lines and the faces between them change there and nowhere else. Gives what SlabSweep gives, wherever
// doubles are sure of every order; else it declines.
#pragma once

#include <span>
#include <vector>

#include "analytic/leaf_lines.h"
#include "analytic/open_piece.h"

namespace edgewise {

/// Holds the scratch memory of one thread.
class EventSweep {
  public:
    /// Whether the owners of the leaf's cell were appended to `out`. False, with `out` untouched, where
    /// rounding could decide anything: an order of lines or of depths, horizontal lines, lines that touch
    /// without crossing; where triangles are seen through; and of more than 64 triangles.
    /// O(events (lines + triangles) + rows * lines).
    bool run(const LeafLines& leaf, CellOutput& out);

  private:
    /// Lines `p` and `q` cross at `at`, or p begins (q = kBegins) or ends (q = kEnds) there.
    struct Happening {
        OrderKey key;
        const FinePoint* at;
        std::uint32_t p, q;
    };
    /// Between two neighbouring lines, or a line and the cell's border.
    struct Face {
        std::uint64_t mask;  ///< the triangles that cover it
        Owner owner;
        bool changed;
    };
    /// A line to which something has happened, and where.
    struct Touched {
        std::uint32_t line;
        const FinePoint* at;
    };
    static constexpr std::uint32_t kBegins = 0xfffffffeu, kEnds = 0xffffffffu;

    bool sweep();
    bool collect();
    bool startAtTop();
    std::uint64_t leftmost(OrderKey key) const;
    bool happen(std::span<const Happening> together);
    bool cross(const Happening& h);
    int sideOf(const FinePoint& p) const;
    bool passSide(const Happening& h, int side);
    bool meet(std::span<const Happening> together);
    bool sortBegun();
    std::size_t placeOf(const FinePoint& p) const;
    bool clearOfNeighbours(const FinePoint& p, std::size_t from, std::size_t to) const;
    bool replace(std::size_t from, std::size_t to);
    bool seeChanged(double y);
    bool see(Face& face, double x, double y) const;
    void relabel();
    void emitRows(OrderKey until);
    double xAt(std::uint32_t line, double y) const;
    double leftBorder() const { return (leaf_->frame.cell.min.x - leaf_->frame.origin.x) + kBorderRestPx; }
    double rightBorder() const { return (leaf_->frame.cell.max.x - leaf_->frame.origin.x) + kBorderRestPx; }

    const LeafLines* leaf_ = nullptr;
    CellOutput* out_ = nullptr;
    std::vector<Happening> happenings_;
    std::vector<std::uint32_t> order_, begun_;  ///< lines from left to right; those that begin at a point
    std::vector<Face> faces_;                   ///< one more than lines in order_
    std::vector<OpenPiece> pieces_;             ///< one a line
    std::vector<Touched> touched_;              ///< since the last ordinate
    int next_row_ = 0;
};

}  // namespace edgewise
