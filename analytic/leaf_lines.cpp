#include "analytic/leaf_lines.h"

#include <algorithm>
#include <cmath>

#include "analytic/common_part.h"

namespace edgewise {
namespace {

/// Whether p - q has one certain sign over the whole cell.
bool ordered(const LocalPlane& p, const LocalPlane& q, glm::dvec2 lo, glm::dvec2 hi) {
    const double da = p.a - q.a, db = p.b - q.b, c = p.c - q.c;
    const double x0 = std::min(da * lo.x, da * hi.x), x1 = std::max(da * lo.x, da * hi.x);
    const double y0 = std::min(db * lo.y, db * hi.y), y1 = std::max(db * lo.y, db * hi.y);
    const double error = 2.0 * (p.error + q.error);
    return c + (x0 + y0) > error || c + (x1 + y1) < -error;
}

bool boxesOverlap(const ScreenTriangle& s, const ScreenTriangle& t) {
    for (glm::length_t k = 0; k < 2; ++k) {
        const double s0 = std::min({s.p_px[0][k], s.p_px[1][k], s.p_px[2][k]});
        const double s1 = std::max({s.p_px[0][k], s.p_px[1][k], s.p_px[2][k]});
        const double t0 = std::min({t.p_px[0][k], t.p_px[1][k], t.p_px[2][k]});
        const double t1 = std::max({t.p_px[0][k], t.p_px[1][k], t.p_px[2][k]});
        if (s1 <= t0 || t1 <= s0) return false;
    }
    return true;
}

/// Whether some edge of s has t on its outer side, where t may touch the edge's ends: surely.
bool separates(const ScreenTriangle& s, const ScreenTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a = s.p_px[k], e = s.p_px[(k + 1) % 3] - a;
        bool outside = true;
        for (const glm::dvec2& v : t.p_px) {
            const glm::dvec2 d = v - a;
            if (v == a || d == e) continue;
            const double px = e.x * d.y, py = e.y * d.x;
            outside = outside && px - py < -3.0 * 0x1p-53 * (std::abs(px) + std::abs(py));
        }
        if (outside) return true;
    }
    return false;
}

/// Edges that meet in a vertex cross nowhere else.
bool meetInVertex(const Carrier& p, const Carrier& q) {
    return p.isEdge() && q.isEdge() && (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b);
}

/// A line inside a cell in plain doubles, from the cell's origin.
struct Course {
    double x, y, y_end, slope, error;

    Course(const LeafLine& line, const CellFrame& frame)
        : x(frame.localX(line.enter)),
          y(frame.localY(yOf(line.enter))),
          y_end(frame.localY(yOf(line.exit))),
          slope(line.slope),
          error(line.abscissaError()) {}
    double xAt(double at_y) const { return x + (at_y - y) * slope; }
};

/// Whether p surely stays on one side of q where both run inside the cell.
bool staysBeside(const Course& p, const Course& q) {
    const double y0 = std::max(p.y, q.y), y1 = std::min(p.y_end, q.y_end), error = p.error + q.error;
    const double d0 = p.xAt(y0) - q.xAt(y0), d1 = p.xAt(y1) - q.xAt(y1);
    return (d0 > error && d1 > error) || (d0 < -error && d1 < -error);
}

}  // namespace

void LeafLines::collect(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                        std::span<const std::uint32_t> triangles, const VisibilityOptions& options,
                        VisibilityCounts& counts) {
    frame = CellFrame(cell, origin);
    planes.clear(), lines.clear(), horizontals.clear(), events.clear(), masks.clear();
    words = std::max<std::size_t>(1, (triangles.size() + 63) / 64);
    see_through.assign(words, 0), any_see_through = false;
    const double reach = std::max(cell.max.x - origin.x, cell.max.y - origin.y) + 1.0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        planes.push_back(localPlane(scene, scene.triangles[triangles[i]], origin, reach));
        if (scene.seesThrough(planes.back().owner))
            see_through[i / 64] |= std::uint64_t{1} << (i % 64), any_see_through = true;
        for (std::uint32_t k = 0; k < 3; ++k) addEdge(scene, triangles[i], k, i);
    }
    addDepthLines(scene, triangles, options.every_depth_line, counts);
    addCrossings();
}

void LeafLines::addEdge(const ScreenScene& scene, std::uint32_t triangle, std::uint32_t edge,
                        std::size_t bit) {
    LeafLine line;
    line.carrier = edgeCarrier(scene, LineRef::edge(triangle, edge));
    const Carrier& c = line.carrier;
    if (c.horizontal()) {
        LeafHorizontal horizontal;
        if (clipHorizontalEdge(frame, c, horizontal)) horizontals.push_back(horizontal);
        return;
    }
    const std::uint64_t mark = std::uint64_t{1} << (bit % 64);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!lines[i].carrier.isEdge() || !sameEdge(lines[i].carrier, c)) continue;
        masks[i * words + bit / 64] ^= mark;
        if (c.ref < lines[i].carrier.ref) lines[i].carrier.ref = c.ref;
        return;
    }
    if (!clipEdge(frame, line)) return;
    lines.push_back(line);
    masks.resize(lines.size() * words, 0);
    masks[(lines.size() - 1) * words + bit / 64] = mark;
}

void LeafLines::addDepthLines(const ScreenScene& scene, std::span<const std::uint32_t> triangles, bool every,
                              VisibilityCounts& counts) {
    const glm::dvec2 lo = frame.cell.min - frame.origin;
    const glm::dvec2 hi = frame.cell.max - frame.origin + glm::dvec2(2.0 * kBorderRestPx);
    const std::size_t before = lines.size() + horizontals.size();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = i + 1; j < triangles.size(); ++j) {
            const LocalPlane &p = planes[i], &q = planes[j];
            if (p.plane == q.plane || p.owner == q.owner) continue;
            const ScreenTriangle &s = scene.triangles[triangles[i]], &t = scene.triangles[triangles[j]];
            if (every) {
                addDepthLine(scene, LineRef::depth(p.plane, q.plane));
                continue;
            }
            if (ordered(p, q, lo, hi) || !boxesOverlap(s, t) || separates(s, t) || separates(t, s)) continue;
            if (f64::signsAtVertices(s, p, q, frame.origin) != 3) continue;
            if (f64::signsAtVertices(t, p, q, frame.origin) != 3) continue;
            if (f64::signsOver(f64::commonPart(s, t, frame.origin, lo, hi), p, q) != 3) continue;
            addDepthLine(scene, LineRef::depth(p.plane, q.plane));
        }
    }
    counts.depth_lines += lines.size() + horizontals.size() - before;
}

void LeafLines::addDepthLine(const ScreenScene& scene, LineRef ref) {
    LeafLine line;
    line.carrier = depthCarrier(scene, ref);
    const Carrier& c = line.carrier;
    if (c.A.hi == 0.0 && c.B.hi == 0.0) return;
    for (const LeafLine& known : lines)
        if (known.carrier.ref == c.ref) return;
    for (const LeafHorizontal& known : horizontals)
        if (known.carrier.ref == c.ref) return;
    if (c.horizontal()) {
        FineCoordinate y = yOf(pointAtX(c, border(frame.cell.min.x)));
        if (frame.key(y) == frame.bottom) y.rest -= 0x1p-76;  // on the border, which belongs to this cell
        const OrderKey key = frame.key(y);
        if (key > frame.top && key < frame.bottom)
            horizontals.push_back(
                {c, key, y, finePoint(border(frame.cell.min.x), y), finePoint(border(frame.cell.max.x), y)});
        return;
    }
    if (!clipDepthLine(frame, line)) return;
    lines.push_back(line);
    masks.resize(lines.size() * words, 0);
}

void LeafLines::addCrossings() {
    // Abscissae here carry a few roundings of the cell's size, far below this; the crossing itself is decided
    // exactly.
    constexpr double kPad = kGridPx;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const LeafLine& p = lines[i];
        if (!p.runsInside()) continue;
        const Course course(p, frame);
        for (std::size_t j = i + 1; j < lines.size(); ++j) {
            const LeafLine& q = lines[j];
            if (!q.runsInside() || p.in1 < q.in0 || q.in1 < p.in0) continue;
            if (p.x_high + kPad < q.x_low || q.x_high + kPad < p.x_low) continue;
            if (staysBeside(course, {q, frame}) || meetInVertex(p.carrier, q.carrier)) continue;
            FinePoint point;
            if (!crossing(p.carrier, q.carrier, point)) continue;
            const OrderKey key = frame.key(yOf(point));
            if (key < std::max(p.in0, q.in0) || key > std::min(p.in1, q.in1)) continue;
            events.push_back({key, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), point});
        }
    }
}

void LeafLines::addKey(OrderKey key, FineCoordinate y) {
    if (key > frame.top && key < frame.bottom) key_scratch_.emplace_back(key, y);
}

void LeafLines::sortKeys() {
    key_scratch_.clear();
    for (const LeafLine& line : lines) {
        if (line.runsInside()) {
            addKey(line.in0, yOf(line.enter));
            addKey(line.in1, yOf(line.exit));
        }
        const bool left_above = line.side_before < 0, left_below = line.side_after < 0;
        if (line.carrier.isEdge() && (left_above || left_below || line.runsInside())) {
            addKey(line.y0, {line.carrier.a.y, 0.0});
            addKey(line.y1, {line.carrier.b.y, 0.0});
        }
    }
    for (const LeafEvent& event : events) addKey(event.key, yOf(event.point));
    for (const LeafHorizontal& h : horizontals) addKey(h.key, h.y);
    std::stable_sort(key_scratch_.begin(), key_scratch_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    keys.assign(1, frame.top), ordinates.assign(1, border(frame.cell.min.y));
    for (const auto& [key, y] : key_scratch_) {
        if (key == keys.back()) continue;
        keys.push_back(key);
        ordinates.push_back(y);
    }
    keys.push_back(frame.bottom), ordinates.push_back(border(frame.cell.max.y));
    std::stable_sort(events.begin(), events.end(),
                     [](const LeafEvent& a, const LeafEvent& b) { return a.key < b.key; });
    std::stable_sort(horizontals.begin(), horizontals.end(),
                     [](const LeafHorizontal& a, const LeafHorizontal& b) { return a.key < b.key; });
}

}  // namespace edgewise
