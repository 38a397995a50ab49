#include "analytic/sheet_certificate.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace edgewise {
namespace {

/// cross(e, p - a) for each edge of t, the smallest, with the bound of its rounding.
struct InnerDistance {
    double value, error;
};

InnerDistance innerDistance(const ScreenTriangle& t, glm::dvec2 p) {
    InnerDistance smallest{HUGE_VAL, 0.0};
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], e = t.p_px[(k + 1) % 3] - a, d = p - a;
        const double x = e.x * d.y, y = e.y * d.x;
        if (x - y < smallest.value) smallest = {x - y, 3.0 * 0x1p-53 * (std::abs(x) + std::abs(y))};
    }
    return smallest;
}

/// Whether p lies in exactly one triangle; false also where rounding leaves it open.
bool coveredOnce(const ScreenScene& scene, std::span<const std::uint32_t> triangles, glm::dvec2 p) {
    int inside = 0;
    for (const std::uint32_t i : triangles) {
        const InnerDistance d = innerDistance(scene.triangles[i], p);
        if (std::abs(d.value) <= d.error) return false;
        inside += d.value > 0.0;
    }
    return inside == 1;
}

/// Whether the segment a -> b may meet the cell.
bool mayMeet(glm::dvec2 a, glm::dvec2 b, const Cell& cell) {
    if (std::max(a.x, b.x) <= cell.min.x || std::min(a.x, b.x) > cell.max.x) return false;
    if (std::max(a.y, b.y) <= cell.min.y || std::min(a.y, b.y) > cell.max.y) return false;
    const glm::dvec2 e = b - a, c = 0.5 * (cell.min + cell.max) - a, h = 0.5 * (cell.max - cell.min);
    const double middle = e.x * c.y - e.y * c.x;
    const double reach = std::abs(e.x) * h.y + std::abs(e.y) * h.x;
    const double slack = (std::abs(e.x) + std::abs(e.y)) * (2.0 * kBorderRestPx) +
                         4.0 * 0x1p-53 * (std::abs(e.x * c.y) + std::abs(e.y * c.x) + reach);
    return std::abs(middle) <= reach + slack;
}

bool runsCanonically(glm::dvec2 a, glm::dvec2 b) {
    return a.y < b.y || (a.y == b.y && a.x > b.x);
}

}  // namespace

bool SheetCertificate::enter(const ScreenScene& scene, std::uint32_t triangle, std::uint32_t k) {
    const ScreenTriangle& t = scene.triangles[triangle];
    const std::uint32_t u = t.vertex[k], v = t.vertex[(k + 1) % 3];
    const std::uint64_t ends = (static_cast<std::uint64_t>(std::min(u, v)) << 32) | std::max(u, v);
    const std::size_t room = slots_.size() - 1;
    std::size_t slot = (ends * 0x9e3779b97f4a7c15ull >> 17) & room;
    while (slots_[slot] != 0 && edges_[slots_[slot] - 1].ends != ends) slot = (slot + 1) & room;
    const bool canonical = runsCanonically(t.p_px[k], t.p_px[(k + 1) % 3]);
    if (slots_[slot] == 0) {
        edges_.push_back({ends, LineRef::edge(triangle, k)});
        slots_[slot] = static_cast<std::uint32_t>(edges_.size());
    }
    SharedEdge& edge = edges_[slots_[slot] - 1];
    std::uint32_t& side = canonical ? edge.with : edge.against;
    if (side != SharedEdge::kUnused) return false;
    side = triangle;
    edge.canonical = std::min(edge.canonical, LineRef::edge(triangle, k));
    return true;
}

bool SheetCertificate::pairEdges(const ScreenScene& scene, const Cell& cell,
                                 std::span<const std::uint32_t> triangles) {
    edges_.clear();
    slots_.assign(std::bit_ceil(4 * triangles.size() + 4), 0);
    for (const std::uint32_t i : triangles) {
        const auto& p = scene.triangles[i].p_px;
        for (std::uint32_t k = 0; k < 3; ++k)
            if (mayMeet(p[k], p[(k + 1) % 3], cell) && !enter(scene, i, k)) return false;
    }
    return std::all_of(edges_.begin(), edges_.end(), [](const SharedEdge& e) {
        return e.with != SharedEdge::kUnused && e.against != SharedEdge::kUnused;
    });
}

void SheetCertificate::emitEdge(const ScreenScene& scene, const CellFrame& frame, const SharedEdge& edge,
                                CellOutput& out) {
    const Owner left = scene.triangles[edge.with].owner, right = scene.triangles[edge.against].owner;
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
            return innerDistance(scene.triangles[i], {middle, row + 0.5}).value;
        };
        const auto holder =
            std::max_element(triangles.begin(), triangles.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return inner(a) < inner(b); });
        out.rows.push_back({row, scene.triangles[*holder].owner, start});
    }
}

bool SheetCertificate::run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                           std::span<const std::uint32_t> triangles, CellOutput& out) {
    const auto see_through = [&](std::uint32_t i) { return scene.seesThrough(scene.triangles[i].owner); };
    if (triangles.empty() || std::ranges::any_of(triangles, see_through)) return false;
    if (!pairEdges(scene, cell, triangles)) return false;
    const glm::dvec2 size = cell.max - cell.min;
    // Two generic points: a vertex or an edge may lie on one of them.
    if (!coveredOnce(scene, triangles, cell.min + size * glm::dvec2(0.5078125, 0.4765625)) &&
        !coveredOnce(scene, triangles, cell.min + size * glm::dvec2(0.2734375, 0.6171875)))
        return false;
    const CellFrame frame(cell, origin);
    crossings_.clear();
    const std::size_t emitted = out.segments.size();
    for (const SharedEdge& edge : edges_) emitEdge(scene, frame, edge, out);
    if (!sortRows()) {
        out.segments.resize(emitted);
        return false;
    }
    emitRows(scene, frame, triangles, out);
    ++out.counts.certified;
    return true;
}

}  // namespace edgewise
