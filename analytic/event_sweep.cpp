#include "analytic/event_sweep.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace edgewise {
namespace {

template <class T>
auto at(std::vector<T>& list, std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(i);
}

}  // namespace

bool EventSweep::run(const LeafLines& leaf, CellOutput& out) {
    if (leaf.words != 1 || leaf.any_see_through || !leaf.horizontals.empty()) return false;
    leaf_ = &leaf, out_ = &out;
    const std::size_t segments = out.segments.size(), rows = out.rows.size();
    if (sweep()) return true;
    out.segments.resize(segments), out.rows.resize(rows);
    return false;
}

bool EventSweep::sweep() {
    if (!collect() || !startAtTop()) return false;
    const CellFrame& frame = leaf_->frame;
    std::uint64_t ordinates = 1;
    double y = frame.localY(border(frame.cell.min.y));
    OrderKey key = frame.top;
    for (std::size_t i = 0;; ++ordinates) {
        const bool last = i == happenings_.size();
        const FineCoordinate y_next = last ? border(frame.cell.max.y) : yOf(*happenings_[i].at);
        if (!seeChanged(0.5 * (y + frame.localY(y_next)))) return false;
        relabel();
        emitRows(last ? frame.bottom : happenings_[i].key);
        if (last) break;
        key = happenings_[i].key, y = frame.localY(y_next);
        while (i < happenings_.size() && happenings_[i].key == key) {
            std::size_t end = i + 1;
            while (end < happenings_.size() && happenings_[end].key == key &&
                   samePoint(*happenings_[end].at, *happenings_[i].at))
                ++end;
            if (!happen(std::span(happenings_).subspan(i, end - i))) return false;
            i = end;
        }
    }
    if (faces_.front().mask != leftmost(key)) return false;
    for (const std::uint32_t line : order_)
        pieces_[line].close(leaf_->lines[line], leaf_->lines[line].exit, out_->segments);
    ++out_->counts.cells, ++out_->counts.by_events;
    out_->counts.slabs += ordinates;
    return true;
}

/// All that happens inside the cell, by ordinate, then by abscissa.
bool EventSweep::collect() {
    const CellFrame& frame = leaf_->frame;
    happenings_.clear();
    for (std::uint32_t i = 0; i < leaf_->lines.size(); ++i) {
        const LeafLine& line = leaf_->lines[i];
        if (!line.runsInside()) continue;
        if (line.in0 > frame.top) happenings_.push_back({line.in0, &line.enter, i, kBegins});
        if (line.in1 < frame.bottom) happenings_.push_back({line.in1, &line.exit, i, kEnds});
    }
    for (const LeafEvent& event : leaf_->events) {
        if (event.key <= frame.top || event.key >= frame.bottom) return false;
        happenings_.push_back({event.key, &event.point, event.p, event.q});
    }
    std::sort(happenings_.begin(), happenings_.end(), [](const Happening& a, const Happening& b) {
        if (a.key != b.key) return a.key < b.key;
        const double dx = difference(xOf(*a.at), xOf(*b.at));
        return dx != 0.0 ? dx < 0.0 : a.q != b.q ? a.q < b.q : a.p < b.p;
    });
    return true;
}

/// The lines that the cell's upper border cuts, and the faces between them.
bool EventSweep::startAtTop() {
    const CellFrame& frame = leaf_->frame;
    pieces_.assign(leaf_->lines.size(), OpenPiece{});
    order_.clear(), touched_.clear();
    for (std::uint32_t i = 0; i < leaf_->lines.size(); ++i) {
        const LeafLine& line = leaf_->lines[i];
        if (!line.runsInside() || line.in0 != frame.top) continue;
        const double x = frame.localX(line.enter);
        std::size_t place = order_.size();
        for (; place > 0; --place) {
            const LeafLine& other = leaf_->lines[order_[place - 1]];
            const double d = x - frame.localX(other.enter),
                         least = line.abscissaError() + other.abscissaError();
            if (d > least) break;
            if (d >= -least) return false;
        }
        order_.insert(at(order_, place), i);
        touched_.push_back({i, &line.enter});
    }
    faces_.assign(1, {leftmost(frame.top), kBackground, true});
    for (const std::uint32_t line : order_)
        faces_.push_back({faces_.back().mask ^ leaf_->masks[line], kBackground, true});
    next_row_ = static_cast<int>(std::floor(frame.cell.min.y - 0.5));
    while (frame.key({next_row_ + 0.5, 0.0}) < frame.top) ++next_row_;
    return true;
}

/// The triangles that cover the cell's left border just below an ordinate.
std::uint64_t EventSweep::leftmost(OrderKey key) const {
    std::uint64_t mask = 0;
    for (std::size_t i = 0; i < leaf_->lines.size(); ++i) {
        const LeafLine& line = leaf_->lines[i];
        if (key < line.y0 || key >= line.y1) continue;
        const int side = key >= line.in1 ? line.side_after : key < line.in0 ? line.side_before : 0;
        if (side < 0) mask ^= leaf_->masks[i];
    }
    return mask;
}

/// What happens at one point.
bool EventSweep::happen(std::span<const Happening> together) {
    const Happening& first = together.front();
    if (first.q != kBegins && first.q != kEnds) return together.size() == 1 && cross(first);
    if (const int side = sideOf(*first.at); side != 0) return together.size() == 1 && passSide(first, side);
    return meet(together);
}

/// Neighbours change places; the face between them is a new one.
bool EventSweep::cross(const Happening& h) {
    const auto place = std::ranges::find_if(order_, [&](std::uint32_t i) { return i == h.p || i == h.q; });
    const auto i = static_cast<std::size_t>(place - order_.begin());
    if (i + 1 >= order_.size() || (order_[i + 1] != h.p && order_[i + 1] != h.q)) return false;
    if (!(leaf_->lines[order_[i]].slope > leaf_->lines[order_[i + 1]].slope)) return false;
    if (!clearOfNeighbours(*h.at, i, i + 2)) return false;
    std::swap(order_[i], order_[i + 1]);
    faces_[i + 1] = {faces_[i].mask ^ leaf_->masks[order_[i]], kBackground, true};
    touched_.push_back({h.p, h.at}), touched_.push_back({h.q, h.at});
    return true;
}

/// -1 on the cell's left border, 1 on its right one.
int EventSweep::sideOf(const FinePoint& p) const {
    if (p.rest.x != kBorderRestPx) return 0;
    const Cell& cell = leaf_->frame.cell;
    return p.grid.x == cell.min.x ? -1 : p.grid.x == cell.max.x ? 1 : 0;
}

/// A line comes in or leaves through a side border: so does the face behind it.
bool EventSweep::passSide(const Happening& h, int side) {
    const bool begins = h.q == kBegins;
    const std::size_t outermost = side < 0 ? 0 : order_.size() - (begins ? 0 : 1);
    if (begins) {
        const std::uint64_t mask = faces_[outermost].mask ^ leaf_->masks[h.p];
        const std::size_t face = side < 0 ? 0 : faces_.size();
        if (!clearOfNeighbours(*h.at, outermost, outermost)) return false;
        touched_.push_back({h.p, h.at});
        order_.insert(at(order_, outermost), h.p);
        faces_.insert(at(faces_, face), {mask, kBackground, true});
        return true;
    }
    if (order_.empty() || order_[outermost] != h.p) return false;
    if (!clearOfNeighbours(*h.at, outermost, outermost + 1)) return false;
    pieces_[h.p].close(leaf_->lines[h.p], *h.at, out_->segments);
    order_.erase(at(order_, outermost));
    faces_.erase(at(faces_, side < 0 ? 0 : faces_.size() - 1));
    return true;
}

/// Lines end in a vertex, and others begin there.
bool EventSweep::meet(std::span<const Happening> together) {
    begun_.clear();
    std::size_t from = order_.size(), to = 0, ended = 0;
    for (const Happening& h : together) {
        if (h.q == kBegins) {
            begun_.push_back(h.p), touched_.push_back({h.p, h.at});
            continue;
        }
        const auto place = static_cast<std::size_t>(std::ranges::find(order_, h.p) - order_.begin());
        if (place == order_.size()) return false;
        from = std::min(from, place), to = std::max(to, place + 1), ++ended;
    }
    const FinePoint& vertex = *together.front().at;
    if (ended == 0) from = to = placeOf(vertex);
    return to - from == ended && sortBegun() && clearOfNeighbours(vertex, from, to) && replace(from, to);
}

/// Lines that begin in one point, by slope.
bool EventSweep::sortBegun() {
    const auto slope = [this](std::uint32_t i) { return leaf_->lines[i].slope; };
    std::ranges::sort(begun_, {}, slope);
    for (std::size_t i = 1; i < begun_.size(); ++i) {
        const double a = slope(begun_[i - 1]), b = slope(begun_[i]);
        if (!(b - a > 4.0 * 0x1p-53 * (std::abs(a) + std::abs(b)))) return false;
    }
    return true;
}

/// The face that a point lies in, as far as doubles know.
std::size_t EventSweep::placeOf(const FinePoint& p) const {
    const double x = leaf_->frame.localX(p), y = leaf_->frame.localY(yOf(p));
    std::size_t place = 0;
    while (place < order_.size() && xAt(order_[place], y) < x) ++place;
    return place;
}

/// Whether the lines beside lines [from, to) surely pass a point on their side of it.
bool EventSweep::clearOfNeighbours(const FinePoint& p, std::size_t from, std::size_t to) const {
    const double x = leaf_->frame.localX(p), y = leaf_->frame.localY(yOf(p));
    const auto clear = [&](std::uint32_t line, double side) {
        return side * (xAt(line, y) - x) > leaf_->lines[line].abscissaError();
    };
    return (from == 0 || clear(order_[from - 1], -1.0)) && (to == order_.size() || clear(order_[to], 1.0));
}

double EventSweep::xAt(std::uint32_t line, double y) const {
    const LeafLine& l = leaf_->lines[line];
    return leaf_->frame.localX(l.enter) + (y - leaf_->frame.localY(yOf(l.enter))) * l.slope;
}

/// Lines [from, to) end and begun_ take their place, between the same two faces as before.
bool EventSweep::replace(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
        const LeafLine& line = leaf_->lines[order_[i]];
        pieces_[order_[i]].close(line, line.exit, out_->segments);
    }
    const Face right = faces_[to];
    order_.erase(at(order_, from), at(order_, to));
    order_.insert(at(order_, from), begun_.begin(), begun_.end());
    faces_.erase(at(faces_, from + 1), at(faces_, to + 1));
    std::uint64_t mask = faces_[from].mask;
    for (std::size_t i = 0; i < begun_.size(); ++i) {
        mask ^= leaf_->masks[begun_[i]];
        const bool outer = i + 1 == begun_.size();
        faces_.insert(at(faces_, from + 1 + i), outer ? right : Face{mask, kBackground, true});
    }
    if (mask != right.mask) return false;
    const Face& left = faces_[from];
    return !begun_.empty() || (!left.changed && !right.changed && left.owner == right.owner);
}

/// The owners of new faces, at local ordinate y between two happenings.
bool EventSweep::seeChanged(double y) {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        if (!faces_[i].changed) continue;
        double x0 = leftBorder(), x1 = rightBorder(), least = 0.0;
        if (i > 0) x0 = xAt(order_[i - 1], y), least += leaf_->lines[order_[i - 1]].abscissaError();
        if (i < order_.size()) x1 = xAt(order_[i], y), least += leaf_->lines[order_[i]].abscissaError();
        if (!(x1 - x0 > least) || !see(faces_[i], 0.5 * (x0 + x1), y)) return false;
    }
    return true;
}

/// Whether it is sure who is in front of all that cover the face.
bool EventSweep::see(Face& face, double x, double y) const {
    const LocalPlane* best = nullptr;
    bool sure = true;
    const auto planeOf = [&](std::uint64_t bits) -> const LocalPlane& {
        return leaf_->planes[static_cast<std::size_t>(std::countr_zero(bits))];
    };
    for (std::uint64_t bits = face.mask; bits != 0; bits &= bits - 1) {
        const LocalPlane& p = planeOf(bits);
        const int order = best ? filteredOrder(p, *best, x, y) : 1;
        sure = sure && order != 0;
        if (order > 0) best = &p;
    }
    for (std::uint64_t bits = sure ? 0 : face.mask; bits != 0; bits &= bits - 1)
        if (&planeOf(bits) != best && filteredOrder(*best, planeOf(bits), x, y) <= 0) return false;
    face.owner = best ? best->owner : kBackground, face.changed = false;
    return true;
}

/// Pieces end and begin where the owners beside a line change: only where something happened to it.
void EventSweep::relabel() {
    for (const auto& [line, here] : touched_) {
        const auto i = static_cast<std::size_t>(std::ranges::find(order_, line) - order_.begin());
        const Owner left = faces_[i].owner, right = faces_[i + 1].owner;
        OpenPiece& piece = pieces_[line];
        if (piece.open ? piece.left == left && piece.right == right : left == right) continue;
        piece.close(leaf_->lines[line], *here, out_->segments);
        if (left != right) piece.begin(left, right, *here);
    }
    touched_.clear();
}

/// The owners along the sample rows above an ordinate.
void EventSweep::emitRows(OrderKey until) {
    const CellFrame& frame = leaf_->frame;
    for (; frame.key({next_row_ + 0.5, 0.0}) < until; ++next_row_) {
        double reached = frame.cell.min.x + kBorderRestPx;  // rounding must not exchange a thin owner's ends
        out_->rows.push_back({next_row_, faces_.front().owner, reached});
        for (std::size_t i = 0; i < order_.size(); ++i) {
            if (faces_[i].owner == faces_[i + 1].owner) continue;
            const double x = leaf_->lines[order_[i]].xAt(frame, {next_row_ + 0.5, 0.0});
            reached = std::max(reached, frame.origin.x + x);
            out_->rows.push_back({next_row_, faces_[i + 1].owner, reached});
        }
    }
}

}  // namespace edgewise
