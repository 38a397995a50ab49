#include "analytic/merge_segments.h"

#include <algorithm>
#include <tuple>

namespace edgewise {
namespace {

/// Along a line towards its direction: +y, or -x where horizontal.
bool before(const FinePoint& p, const FinePoint& q) {
    return std::tuple(p.grid.y, p.rest.y, -p.grid.x, -p.rest.x) <
           std::tuple(q.grid.y, q.rest.y, -q.grid.x, -q.rest.x);
}

bool joins(const SegmentPiece& p, const SegmentPiece& q) {
    if (p.key != q.key || p.left != q.left || p.right != q.right) return false;
    return samePoint(p.b, q.a);
}

Carrier carrierOf(const ScreenScene& scene, LineRef ref) {
    return ref.isEdge() ? edgeCarrier(scene, ref) : depthCarrier(scene, ref);
}

bool sameLine(const ScreenScene& scene, LineRef p, LineRef q) {
    if (p == q) return true;
    if (!p.isEdge() || !q.isEdge()) return false;
    return sameEdge(edgeCarrier(scene, p), edgeCarrier(scene, q));
}

}  // namespace

bool pieceBefore(const SegmentPiece& p, const SegmentPiece& q) {
    if (p.key != q.key) return p.key < q.key;
    if (before(p.a, q.a)) return true;
    if (before(q.a, p.a)) return false;
    return std::tie(p.left, p.right) < std::tie(q.left, q.right);
}

LayerStacks joinStacks(std::span<CellOutput* const> outputs) {
    std::vector<const LayerStacks*> parts;
    for (const CellOutput* out : outputs) parts.push_back(&out->stacks);
    std::vector<std::vector<Owner>> names;
    LayerStacks table = LayerStacks::joined(parts, names);
    for (std::size_t p = 0; p < outputs.size(); ++p) {
        if (names[p].empty()) continue;
        const auto rename = [&](Owner& owner) {
            if (isStack(owner)) owner = names[p][owner - kFirstStack];
        };
        for (SegmentPiece& piece : outputs[p]->segments) rename(piece.left), rename(piece.right);
        for (RowPiece& piece : outputs[p]->rows) rename(piece.owner);
    }
    return table;
}

namespace {

/// Calls visit(the piece, joined; whether its line is a new one).
template <class Visit>
void forEachMerged(const ScreenScene& scene, std::span<const SegmentPiece> pieces, const Visit& visit) {
    LineRef last = LineRef::closing();
    for (std::size_t i = 0; i < pieces.size();) {
        SegmentPiece piece = pieces[i];
        for (++i; i < pieces.size() && joins(piece, pieces[i]); ++i) piece.b = pieces[i].b;
        const bool is_new = piece.line.isClosing() || last.isClosing() || !sameLine(scene, last, piece.line);
        if (is_new) last = piece.line;
        visit(piece, is_new);
    }
}

}  // namespace

MergedCounts countMerged(const ScreenScene& scene, std::span<const SegmentPiece> pieces) {
    MergedCounts counts;
    forEachMerged(scene, pieces, [&](const SegmentPiece&, bool is_new) {
        ++counts.segments;
        counts.lines += is_new;
    });
    return counts;
}

void mergeInto(const ScreenScene& scene, std::span<const SegmentPiece> pieces, const MergedCounts& before,
               std::span<CarrierLine> lines, std::span<VisibleSegment> segments) {
    MergedCounts at = before;
    forEachMerged(scene, pieces, [&](const SegmentPiece& piece, bool is_new) {
        if (is_new)
            lines[at.lines++] =
                piece.line.isClosing() ? closingLine(piece.a) : carrierLine(carrierOf(scene, piece.line));
        const auto line = static_cast<std::uint32_t>(at.lines - 1);
        segments[at.segments++] = {piece.a, piece.b,    distance(piece.a, piece.b),
                                   line,    piece.left, piece.right};
    });
}

void mergeSorted(const ScreenScene& scene, std::span<const SegmentPiece> pieces, VisibleMap& map) {
    const MergedCounts counts = countMerged(scene, pieces);
    map.lines.resize(counts.lines), map.segments.resize(counts.segments);
    mergeInto(scene, pieces, {}, map.lines, map.segments);
}

std::size_t joinRow(std::span<RowOwner> row) {
    std::stable_sort(row.begin(), row.end(),
                     [](const RowOwner& a, const RowOwner& b) { return a.x_px < b.x_px; });
    return static_cast<std::size_t>(
        std::unique(row.begin(), row.end(),
                    [](const RowOwner& a, const RowOwner& b) { return a.owner == b.owner; }) -
        row.begin());
}

void mergeRows(std::span<const RowPiece> pieces, int row_begin, int row_end, VisibleMap& map) {
    const auto count = static_cast<std::size_t>(std::max(0, row_end - row_begin));
    std::vector<std::vector<RowOwner>> rows(count);
    for (const RowPiece& p : pieces)
        if (p.row >= row_begin && p.row < row_end)
            rows[static_cast<std::size_t>(p.row - row_begin)].push_back({p.x_px, p.owner});
    map.row_begin = row_begin;
    map.row_offset.assign(1, 0);
    map.rows.clear();
    for (std::vector<RowOwner>& row : rows) {
        row.resize(joinRow(row));
        map.rows.insert(map.rows.end(), row.begin(), row.end());
        map.row_offset.push_back(map.rows.size());
    }
}

}  // namespace edgewise
