#include "analytic/edge_visibility.h"

#include <algorithm>
#include <optional>

#include "analytic/exact_depth.h"
#include "analytic/shared_edges.h"

namespace edgewise {

void EdgeVisibility::run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                         std::span<const std::uint32_t> triangles, CellOutput& out) {
    scene_ = &scene, triangles_ = triangles, out_ = &out;
    frame_ = CellFrame(cell, origin);
    planes_.clear(), edges_.clear(), crossings_.clear();
    const double reach = std::max(cell.max.x - origin.x, cell.max.y - origin.y) + 1.0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        planes_.push_back(localPlane(scene, triangle(i), origin, reach));
        for (std::uint32_t k = 0; k < 3; ++k) addEdge(i, k);
    }
    for (const Edge& edge : edges_) {
        cut(edge);
        walk(edge);
    }
    crossings_.sort();
    crossings_.emit(
        cell, [&](glm::dvec2 p) { return ownerAt(p); }, out.rows);
    ++out.counts.cells;
}

void EdgeVisibility::addEdge(std::uint32_t place, std::uint32_t k) {
    Edge edge;
    edge.line.carrier = edgeCarrier(*scene_, LineRef::edge(triangles_[place], k));
    const Carrier& c = edge.line.carrier;
    for (Edge& known : edges_) {
        if (!sameEdge(known.line.carrier, c)) continue;
        known.line.carrier.ref = std::min(known.line.carrier.ref, c.ref);
        return;
    }
    edge.horizontal = c.horizontal();
    if (edge.horizontal) {
        LeafHorizontal h;
        if (!clipHorizontalEdge(frame_, c, h)) return;
        edge.line.enter = h.high, edge.line.exit = h.low;
    } else if (!clipEdge(frame_, edge.line) || !edge.line.runsInside()) {
        return;
    }
    edge.from = keyAlong(edge, edge.line.enter), edge.to = keyAlong(edge, edge.line.exit);
    if (edge.from < edge.to) edges_.push_back(edge);
}

/// Ascending in the edge's direction: +y, or -x.
OrderKey EdgeVisibility::keyAlong(const Edge& edge, const FinePoint& p) const {
    return edge.horizontal ? -orderKey(xOf(p), frame_.origin.x) : frame_.key(yOf(p));
}

void EdgeVisibility::cut(const Edge& edge) {
    events_.clear();
    for (std::vector<std::uint32_t>& covers : covers_) covers.clear();
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        for (const Side side : {kLeft, kRight}) coverBy(edge, i, side);
    for (std::uint32_t i = 0; i < edges_.size(); ++i) coverByEdge(edge, i);
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Event& a, const Event& b) { return a.key < b.key; });
}

/// The part of the edge's moved copy that lies in a triangle.
void EdgeVisibility::coverBy(const Edge& edge, std::uint32_t place, Side side) {
    Cut begin, end;
    for (std::uint32_t k = 0; k < 3; ++k) {
        if (!begin.found) begin = cutBy(edge.line.carrier, place, k, side, true);
        if (!end.found) end = cutBy(edge.line.carrier, place, k, side, false);
    }
    if (!begin.found || !end.found) return;
    addCover(edge, side, place,
             {begin.beyond ? edge.from : keyAlong(edge, begin.at),
              end.beyond ? edge.to : keyAlong(edge, end.at), begin.at, end.at});
}

/// Where edges of one line lie on each other, the lowest is the one that is seen.
void EdgeVisibility::coverByEdge(const Edge& edge, std::uint32_t place) {
    const Carrier &c = edge.line.carrier, &other = edges_[place].line.carrier;
    if (!(other.ref < c.ref) || sideOf(c.a, c.b, other.a) != 0 || sideOf(c.a, c.b, other.b) != 0) return;
    const FinePoint a = gridPoint(other.a), b = gridPoint(other.b);
    addCover(edge, kOn, place, {keyAlong(edge, a), keyAlong(edge, b), a, b});
}

void EdgeVisibility::addCover(const Edge& edge, Side side, std::uint32_t cover, const Cover& part) {
    const OrderKey from = std::max(edge.from, part.from), to = std::min(edge.to, part.to);
    if (!(from < to)) return;
    if (from == edge.from)
        covers_[side].push_back(cover);
    else
        events_.push_back({from, part.begin, side, cover, 1});
    if (to != edge.to) events_.push_back({to, part.end, side, cover, -1});
}

/// Where edge k of a triangle is crossed by the moved copy of `edge`, on the way in or out. What lies on the
/// edge itself is on the other side of its copy, so that no crossing is counted twice or not at all.
EdgeVisibility::Cut EdgeVisibility::cutBy(const Carrier& edge, std::uint32_t place, std::uint32_t k,
                                          Side side, bool enters) const {
    const ScreenTriangle& t = triangle(place);
    const glm::dvec2 u = t.p_px[k], v = t.p_px[(k + 1) % 3];
    const int at_u = sideOf(edge.a, edge.b, u), at_v = sideOf(edge.a, edge.b, v);
    const auto left = [side](int at) { return side == kLeft ? at > 0 : at >= 0; };
    if (left(at_u) == left(at_v) || left(at_u) != enters) return {};
    Cut cut{true, false, {}};
    const int first = sideOf(u, v, edge.a), last = sideOf(u, v, edge.b);
    if (enters ? first >= 0 : last >= 0) {
        cut.beyond = true;
    } else if (enters ? last <= 0 : first <= 0) {
        return {};  // beyond the edge's other end: nothing of it is covered
    } else if (at_u == 0 || at_v == 0) {
        cut.at = gridPoint(at_u == 0 ? u : v);
    } else {
        cut.found = crossing(edge, edgeCarrier(*scene_, LineRef::edge(triangles_[place], k)), cut.at);
    }
    return cut;
}

/// From cut to cut; parts between the same owners are one.
void EdgeVisibility::walk(const Edge& edge) {
    FinePoint start = edge.line.enter, here = start;
    Owner left = kBackground, right = kBackground;
    bool first = true;
    for (std::size_t i = 0; i <= events_.size();) {
        const bool last = i == events_.size();
        const OrderKey key = last ? edge.to : events_[i].key;
        const FinePoint& next = last ? edge.line.exit : events_[i].at;
        const bool another = !covers_[kOn].empty();
        const Owner new_left = another ? kBackground : nearest(edge, kLeft, here, next),
                    new_right = another ? kBackground : nearest(edge, kRight, here, next);
        if (first) left = new_left, right = new_right, first = false;
        if (new_left != left || new_right != right) {
            emit(edge, left, right, start, here);
            start = here, left = new_left, right = new_right;
        }
        if (last) break;
        for (; i < events_.size() && events_[i].key == key; ++i) {
            std::vector<std::uint32_t>& covers = covers_[events_[i].side];
            if (events_[i].by > 0)
                covers.push_back(events_[i].cover);
            else
                std::erase(covers, events_[i].cover);
        }
        here = next;
    }
    emit(edge, left, right, start, edge.line.exit);
}

void EdgeVisibility::emit(const Edge& edge, Owner left, Owner right, const FinePoint& a, const FinePoint& b) {
    if (left == right || samePoint(a, b)) return;
    const Carrier& c = edge.line.carrier;
    out_->segments.push_back({lineKey(c), c.ref, left, right, a, b});
    if (!edge.horizontal) crossings_.add(frame_, edge.line, a, b, left, right);
}

Owner EdgeVisibility::nearest(const Edge& edge, Side side, const FinePoint& a, const FinePoint& b) const {
    const std::vector<std::uint32_t>& covers = covers_[side];
    if (covers.empty()) return kBackground;
    std::uint32_t best = covers.front();
    for (const std::uint32_t place : std::span(covers).subspan(1))
        if (inFront(edge, side, place, best, a, b)) best = place;
    return triangle(best).owner;
}

/// In the middle of a part of the edge, or beside it where the two planes meet in the edge.
bool EdgeVisibility::inFront(const Edge& edge, Side side, std::uint32_t i, std::uint32_t j,
                             const FinePoint& a, const FinePoint& b) const {
    const LocalPlane &p = planes_[i], &q = planes_[j];
    if (p.plane != q.plane && endsIn(edge, i) && endsIn(edge, j)) {
        const glm::dvec2 e = edge.line.carrier.b - edge.line.carrier.a;
        const glm::dvec2 aside = side == kLeft ? glm::dvec2(-e.y, e.x) : glm::dvec2(e.y, -e.x);
        const double rise = (p.a - q.a) * aside.x + (p.b - q.b) * aside.y;
        if (rise != 0.0) return rise > 0.0;
    }
    return inFrontBetween(i, j, a, b);
}

/// In the middle between two points.
bool EdgeVisibility::inFrontBetween(std::uint32_t i, std::uint32_t j, const FinePoint& a,
                                    const FinePoint& b) const {
    const LocalPlane &p = planes_[i], &q = planes_[j];
    const double x = 0.5 * (frame_.localX(a) + frame_.localX(b)),
                 y = 0.5 * (frame_.localY(yOf(a)) + frame_.localY(yOf(b)));
    if (const int order = filteredOrder(p, q, x, y); order != 0) return order > 0;
    ++out_->counts.exact_depth;
    const auto middle = [](FineCoordinate s, FineCoordinate t, double anchor) {
        const f64::dd sum = f64::ddAdd(offsetFrom(s, anchor), offsetFrom(t, anchor));
        return f64::dd{0.5 * sum.hi, 0.5 * sum.lo};
    };
    const glm::dvec2 anchor = scene_->anchor_px;
    const int sign = depthDifferenceSign(scene_->planes[p.plane], scene_->planes[q.plane],
                                         middle(xOf(a), xOf(b), anchor.x), middle(yOf(a), yOf(b), anchor.y));
    return sign != 0 ? sign > 0 : p.owner < q.owner;
}

/// Whether both ends of the edge are vertices of a triangle: then its plane runs through the edge.
bool EdgeVisibility::endsIn(const Edge& edge, std::uint32_t place) const {
    const LineRef ref = edge.line.carrier.ref;
    const ScreenTriangle& own = scene_->triangles[ref.i];
    const std::uint32_t k = ref.j - LineRef::kFirstEdge;
    const auto has = [&](std::uint32_t vertex) {
        return std::ranges::find(triangle(place).vertex, vertex) != triangle(place).vertex.end();
    };
    return has(own.vertex[k]) && has(own.vertex[(k + 1) % 3]);
}

/// Where no visible segment comes near.
Owner EdgeVisibility::ownerAt(glm::dvec2 p_px) const {
    const FinePoint p = gridPoint(p_px);
    std::optional<std::uint32_t> best;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (sideOfTriangle(triangle(i), p_px) < 0) continue;
        if (!best || inFrontBetween(i, *best, p, p)) best = i;
    }
    return best ? triangle(*best).owner : kBackground;
}

}  // namespace edgewise
