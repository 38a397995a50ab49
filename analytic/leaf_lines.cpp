#include "analytic/leaf_lines.h"

#include <algorithm>

namespace edgewise {
namespace {

constexpr OrderKey kFarKey = static_cast<OrderKey>(1) << 120;

OrderKey farSafeKey(FineCoordinate y, double origin) {
    const double offset = y.grid - origin;
    if (!(offset < kGuardBandPx)) return kFarKey;
    if (!(offset > -kGuardBandPx)) return -kFarKey;
    return orderKey(y, origin);
}

int regionOf(double grid_x, const Cell& cell) { return grid_x <= cell.min.x ? -1 : grid_x > cell.max.x ? 1 : 0; }

FineCoordinate border(double grid) { return {grid, kBorderRestPx}; }

/// A sign of p - q over the vertices of t: bit 0 where it may be positive, bit 1 where it may be negative. A vertex
/// that both triangles share lies in both planes and says nothing.
int signsAtVertices(const ScreenTriangle& t, const ScreenTriangle& other, const LocalPlane& p, const LocalPlane& q,
                    glm::dvec2 origin) {
    int signs = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t id = t.vertex[k];
        if (id == other.vertex[0] || id == other.vertex[1] || id == other.vertex[2]) continue;
        const glm::dvec2 v = t.p_px[k] - origin;
        const double d = depthAt(p, v.x, v.y) - depthAt(q, v.x, v.y);
        // Roundings beyond the leaf's own bound: the vertex may lie far outside the cell.
        const double far = (std::abs(p.a) + std::abs(q.a)) * std::abs(v.x) + (std::abs(p.b) + std::abs(q.b)) * std::abs(v.y);
        const double error = p.error + q.error + 8.0 * 0x1p-53 * far;
        if (d > -error) signs |= 1;
        if (d < error) signs |= 2;
    }
    return signs;
}

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

/// Whether some edge of s has t surely on its outer side.
bool separates(const ScreenTriangle& s, const ScreenTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a = s.p_px[k], e = s.p_px[(k + 1) % 3] - a;
        bool outside = true;
        for (const glm::dvec2& v : t.p_px) {
            const glm::dvec2 d = v - a;
            const double px = e.x * d.y, py = e.y * d.x;
            outside = outside && px - py < -3.0 * 0x1p-53 * (std::abs(px) + std::abs(py));
        }
        if (outside) return true;
    }
    return false;
}

bool shareEndpoint(const Carrier& p, const Carrier& q) {
    return p.isEdge() && q.isEdge() && (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b);
}

}  // namespace

void LeafLines::collect(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                        std::span<const std::uint32_t> triangles, const VisibilityOptions& options,
                        VisibilityCounts& counts) {
    cell_ = cell;
    origin_ = origin;
    planes.clear(), lines.clear(), horizontals.clear(), events.clear(), masks.clear(), key_scratch_.clear();
    words = std::max<std::size_t>(1, (triangles.size() + 63) / 64);
    top = orderKey(border(cell.min.y), origin.y);
    bottom = orderKey(border(cell.max.y), origin.y);
    const double reach = std::max(cell.max.x - origin.x, cell.max.y - origin.y) + 1.0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        planes.push_back(localPlane(scene, scene.triangles[triangles[i]], origin, reach));
        for (std::uint32_t k = 0; k < 3; ++k) addEdge(scene, triangles[i], k, i);
    }
    if (options.piercing) addDepthLines(scene, triangles, counts);
    addCrossings();
    sortKeys();
}

void LeafLines::addEdge(const ScreenScene& scene, std::uint32_t triangle, std::uint32_t edge, std::size_t bit) {
    LeafLine line;
    line.carrier = edgeCarrier(scene, LineRef::edge(triangle, edge));
    const Carrier& c = line.carrier;
    if (c.horizontal()) {
        const bool outside = c.a.y <= cell_.min.y || c.a.y > cell_.max.y || c.a.x <= cell_.min.x || c.b.x > cell_.max.x;
        if (!outside) addHorizontal(c, {c.a.y, 0.0}, gridPoint(c.b), gridPoint(c.a));
        return;
    }
    if (c.b.y <= cell_.min.y || c.a.y > cell_.max.y || (c.a.x > cell_.max.x && c.b.x > cell_.max.x)) return;
    const std::uint64_t mark = std::uint64_t{1} << (bit % 64);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!lines[i].carrier.isEdge() || !sameEdge(lines[i].carrier, c)) continue;
        masks[i * words + bit / 64] ^= mark;
        if (c.ref < lines[i].carrier.ref) lines[i].carrier.ref = c.ref;
        return;
    }
    const OrderKey ka = orderKey({c.a.y, 0.0}, origin_.y), kb = orderKey({c.b.y, 0.0}, origin_.y);
    line.y0 = std::max(ka, top), line.y1 = std::min(kb, bottom);
    if (ka >= top) line.enter = gridPoint(c.a);
    if (kb <= bottom) line.exit = gridPoint(c.b);
    if (!clipSides(line, regionOf(c.a.x, cell_), regionOf(c.b.x, cell_))) return;
    lines.push_back(line);
    masks.resize(lines.size() * words, 0);
    masks[(lines.size() - 1) * words + bit / 64] = mark;
}

/// Fills in0, in1, enter, exit and the sides. False where the line stays right of the cell: it bounds nothing there.
bool LeafLines::clipSides(LeafLine& line, int region_a, int region_b) {
    const Carrier& c = line.carrier;
    line.in0 = line.y0, line.in1 = line.y1;
    bool entered = false, exited = false;
    const auto cross = [&](double grid_x, bool entering, int side) {
        const FinePoint p = pointAtX(c, border(grid_x));
        const OrderKey key = farSafeKey(yOf(p), origin_.y);
        if (entering) {
            line.side_before = side;
            if (key > line.in0) line.in0 = key, line.enter = p, entered = true;
        } else {
            line.side_after = side;
            if (key < line.in1) line.in1 = key, line.exit = p, exited = true;
        }
    };
    if (region_a == region_b && region_a != 0) {
        if (region_a > 0) return false;
        line.side_before = line.side_after = -1;
        line.in0 = line.in1 = line.y0;
        return true;
    }
    if (region_a != 0) cross(region_a < 0 ? cell_.min.x : cell_.max.x, true, region_a);
    if (region_b != 0) cross(region_b < 0 ? cell_.min.x : cell_.max.x, false, region_b);
    if (!line.runsInside()) return line.side_before < 0 || line.side_after < 0;
    const bool a_above = !c.isEdge() || orderKey({c.a.y, 0.0}, origin_.y) < top;
    const bool b_below = !c.isEdge() || orderKey({c.b.y, 0.0}, origin_.y) > bottom;
    if (!entered && a_above) line.enter = line.y0 == top ? pointAtY(c, border(cell_.min.y)) : line.enter;
    if (!exited && b_below) line.exit = line.y1 == bottom ? pointAtY(c, border(cell_.max.y)) : line.exit;
    line.slope = c.slope();
    const double x0 = localX(line.enter), x1 = localX(line.exit);
    line.x_low = std::min(x0, x1), line.x_high = std::max(x0, x1);
    return true;
}

void LeafLines::addHorizontal(const Carrier& carrier, FineCoordinate y, FinePoint low, FinePoint high) {
    if (low.grid.x <= cell_.min.x) low = finePoint(border(cell_.min.x), y);
    if (high.grid.x > cell_.max.x) high = finePoint(border(cell_.max.x), y);
    horizontals.push_back({carrier, orderKey(y, origin_.y), y, low, high, localX(low), localX(high)});
}

void LeafLines::addDepthLines(const ScreenScene& scene, std::span<const std::uint32_t> triangles,
                              VisibilityCounts& counts) {
    const glm::dvec2 lo = cell_.min - origin_, hi = cell_.max - origin_ + glm::dvec2(2.0 * kBorderRestPx);
    const std::size_t before = lines.size() + horizontals.size();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = i + 1; j < triangles.size(); ++j) {
            const LocalPlane &p = planes[i], &q = planes[j];
            if (p.plane == q.plane || p.owner == q.owner || ordered(p, q, lo, hi)) continue;
            const ScreenTriangle &s = scene.triangles[triangles[i]], &t = scene.triangles[triangles[j]];
            if (signsAtVertices(s, t, p, q, origin_) != 3 || signsAtVertices(t, s, p, q, origin_) != 3) continue;
            if (!boxesOverlap(s, t) || separates(s, t) || separates(t, s)) continue;
            addDepthLine(scene, s, t);
        }
    }
    counts.depth_lines += lines.size() + horizontals.size() - before;
}

void LeafLines::addDepthLine(const ScreenScene& scene, const ScreenTriangle& p, const ScreenTriangle& q) {
    LeafLine line;
    line.carrier = depthCarrier(scene, LineRef::depth(p.plane, q.plane));
    const Carrier& c = line.carrier;
    if (c.A.hi == 0.0 && c.B.hi == 0.0) return;
    for (const LeafLine& known : lines)
        if (known.carrier.ref == c.ref) return;
    for (const LeafHorizontal& known : horizontals)
        if (known.carrier.ref == c.ref) return;
    if (c.horizontal()) {
        const FineCoordinate y = yOf(pointAtX(c, border(cell_.min.x)));
        const OrderKey key = farSafeKey(y, origin_.y);
        if (key > top && key < bottom)
            addHorizontal(c, y, finePoint(border(cell_.min.x), y), finePoint(border(cell_.max.x), y));
        return;
    }
    line.y0 = top, line.y1 = bottom;
    int region_a = 0, region_b = 0;
    const double slope = c.slope();
    if (slope != 0.0) {
        region_a = slope > 0.0 ? -1 : 1;
        region_b = -region_a;
    } else {
        const FinePoint p_top = pointAtY(c, border(cell_.min.y));
        const double x = p_top.grid.x + p_top.rest.x;
        region_a = region_b = regionOf(x, cell_);
        if (region_a != 0) return;
    }
    if (!clipSides(line, region_a, region_b) || !line.runsInside()) return;
    lines.push_back(line);
    masks.resize(lines.size() * words, 0);
}

void LeafLines::addCrossings() {
    // Abscissae here carry a few roundings of the cell's size, far below this; the crossing itself is decided exactly.
    constexpr double kPad = kGridPx;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const LeafLine& p = lines[i];
        if (!p.runsInside()) continue;
        for (std::size_t j = i + 1; j < lines.size(); ++j) {
            const LeafLine& q = lines[j];
            if (!q.runsInside() || p.in1 < q.in0 || q.in1 < p.in0) continue;
            if (p.x_high + kPad < q.x_low || q.x_high + kPad < p.x_low) continue;
            if (shareEndpoint(p.carrier, q.carrier)) continue;
            FinePoint point;
            if (!crossing(p.carrier, q.carrier, point)) continue;
            const OrderKey key = farSafeKey(yOf(point), origin_.y);
            if (key < std::max(p.in0, q.in0) || key > std::min(p.in1, q.in1)) continue;
            events.push_back({key, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), point});
        }
    }
}

void LeafLines::addKey(OrderKey key, FineCoordinate y) {
    if (key > top && key < bottom) key_scratch_.emplace_back(key, y);
}

void LeafLines::sortKeys() {
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
    const auto byKey = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::sort(key_scratch_.begin(), key_scratch_.end(), byKey);
    keys.assign(1, top), ordinates.assign(1, border(cell_.min.y));
    for (const auto& [key, y] : key_scratch_) {
        if (key == keys.back()) continue;
        keys.push_back(key);
        ordinates.push_back(y);
    }
    keys.push_back(bottom), ordinates.push_back(border(cell_.max.y));
    std::sort(events.begin(), events.end(), [](const LeafEvent& a, const LeafEvent& b) { return a.key < b.key; });
    std::sort(horizontals.begin(), horizontals.end(),
              [](const LeafHorizontal& a, const LeafHorizontal& b) { return a.key < b.key; });
}

}  // namespace edgewise
