#include "analytic/sheet_certificate.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace edgewise {
namespace {

/// The smallest cross(e, p - a) over the edges of t: positive inside.
double innerDistance(const ScreenTriangle& t, glm::dvec2 p) {
    double smallest = HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], e = t.p_px[(k + 1) % 3] - a, d = p - a;
        smallest = std::min(smallest, e.x * d.y - e.y * d.x);
    }
    return smallest;
}

/// Whether p lies in exactly one triangle; false also where rounding leaves it open.
bool coveredOnce(const ScreenScene& scene, std::span<const std::uint32_t> triangles, glm::dvec2 p) {
    int inside = 0;
    for (const std::uint32_t i : triangles) {
        const int side = sideOfTriangle(scene.triangles[i], p);
        if (side == 0) return false;
        inside += side > 0;
    }
    return inside == 1;
}

}  // namespace

void SheetCertificate::emitEdge(const ScreenScene& scene, const CellFrame& frame,
                                std::span<const std::uint32_t> triangles, const SharedEdge& edge,
                                CellOutput& out) {
    const Owner left = scene.triangles[triangles[edge.with]].owner,
                right = scene.triangles[triangles[edge.against]].owner;
    const Carrier carrier = edgeCarrier(scene, edge.canonical);
    if (carrier.horizontal()) {
        LeafHorizontal h;
        if (left != right && clipHorizontalEdge(frame, carrier, h))
            out.segments.push_back({lineKey(carrier), carrier.ref, left, right, h.high, h.low});
        return;
    }
    LeafLine line;
    line.carrier = carrier;
    if (!clipEdge(frame, line) || !line.runsInside()) return;
    if (left != right)
        out.segments.push_back({lineKey(carrier), carrier.ref, left, right, line.enter, line.exit});
    const FineCoordinate first = yOf(line.enter), last = yOf(line.exit);
    for (int row = static_cast<int>(std::floor(first.grid - 0.5)); row + 0.5 <= last.grid; ++row) {
        const FineCoordinate y{row + 0.5, 0.0};
        const OrderKey key = orderKey(y, frame.origin.y);
        if (key < line.in0 || key >= line.in1) continue;
        crossings_.push_back({row, frame.origin.x + line.xAt(frame, y), line.slope, left, right});
    }
}

/// Sorts the crossings. False where rounding exchanged the ends of a thin triangle on a row: its labels do
/// not chain.
bool SheetCertificate::sortRows() {
    std::sort(crossings_.begin(), crossings_.end(), [](const RowCrossing& a, const RowCrossing& b) {
        return std::tie(a.row, a.x, a.slope) < std::tie(b.row, b.x, b.slope);
    });
    for (std::size_t k = 0; k + 1 < crossings_.size(); ++k) {
        const RowCrossing &a = crossings_[k], &b = crossings_[k + 1];
        if (a.row == b.row && a.after != b.before) return false;
    }
    return true;
}

/// A row starts with the left owner of its first crossing; without one, a single triangle holds all of it.
void SheetCertificate::emitRows(const ScreenScene& scene, const CellFrame& frame,
                                std::span<const std::uint32_t> triangles, CellOutput& out) {
    const double start = frame.cell.min.x + kBorderRestPx,
                 middle = 0.5 * (frame.cell.min.x + frame.cell.max.x);
    auto next = crossings_.begin();
    for (int row = static_cast<int>(std::floor(frame.cell.min.y - 0.5)); row + 0.5 <= frame.cell.max.y;
         ++row) {
        if (!(row + 0.5 > frame.cell.min.y)) continue;
        if (next != crossings_.end() && next->row == row) {
            out.rows.push_back({row, next->before, start});
            for (; next != crossings_.end() && next->row == row; ++next)
                out.rows.push_back({row, next->after, next->x});
            continue;
        }
        const auto inner = [&](std::uint32_t i) {
            return innerDistance(scene.triangles[i], {middle, row + 0.5});
        };
        const auto holder =
            std::max_element(triangles.begin(), triangles.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return inner(a) < inner(b); });
        out.rows.push_back({row, scene.triangles[*holder].owner, start});
    }
}

bool SheetCertificate::run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                           std::span<const std::uint32_t> triangles, const SharedEdges& shared,
                           CellOutput& out) {
    if (triangles.empty() || !shared.allPaired()) return false;
    const auto points = genericPoints(cell);
    if (std::ranges::none_of(points, [&](glm::dvec2 p) { return coveredOnce(scene, triangles, p); }))
        return false;
    const CellFrame frame(cell, origin);
    crossings_.clear();
    const std::size_t emitted = out.segments.size();
    for (const SharedEdge& edge : shared.edges()) emitEdge(scene, frame, triangles, edge, out);
    if (!sortRows()) {
        out.segments.resize(emitted);
        return false;
    }
    emitRows(scene, frame, triangles, out);
    ++out.counts.certified;
    return true;
}

}  // namespace edgewise
