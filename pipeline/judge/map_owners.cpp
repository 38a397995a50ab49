#include "pipeline/judge/map_owners.h"

#include <algorithm>
#include <cmath>

#include "analytic/fine_point.h"
#include "analytic/row_owners.h"

namespace edgewise::judge {
namespace {

using exact::Rational;

/// Owners entered less owners left: of walls that are met together, what lies before or behind them all.
class Surplus {
  public:
    void clear() { counts_.clear(); }
    bool empty() const {
        return std::ranges::all_of(counts_, [](const auto& count) { return count.second == 0; });
    }
    void step(Owner from, Owner to) { --counts_[from], ++counts_[to]; }
    /// The owner whose surplus has this sign, if it is one and by one.
    std::optional<Owner> only(int sign) const {
        std::optional<Owner> found;
        for (const auto& [owner, count] : counts_) {
            if (count * sign <= 0) continue;
            if (found || count != sign) return {};
            found = owner;
        }
        return found;
    }

  private:
    std::map<Owner, int> counts_;
};

/// How far right of the point a wall is at the point's ordinate. Sums and products of 113 bits round five
/// times.
struct Offset {
    QuadReal value, doubt;
};

Offset offsetAt(const Wall& w, const QuadPoint& p) {
    const QuadReal start = w.a.x - p.x, across = (w.b.x - w.a.x) * ((p.y - w.a.y) / (w.b.y - w.a.y));
    return {start + across, 0x5p-113 * (quadAbs(start) + quadAbs(across))};
}

enum class Sought { kFound, kNothing, kDoubtful };

struct Answer {
    Sought sought;
    Owner owner = kBackground;
};

bool isBehind(const Offset& a, const Offset& b) {
    return a.value - b.value > a.doubt + b.doubt;
}

/// Walls that are met together.
struct Meeting {
    std::optional<Offset> where;
    Surplus met;
    bool doubtful = false;  ///< the point may be on one of them
};

/// The nearest walls whose offset has the sign `way`, behind what was `passed`.
Meeting nextMeeting(const std::vector<Wall>& walls, const QuadPoint& p, int way,
                    const std::optional<Offset>& passed) {
    const double y = static_cast<double>(p.y);
    Meeting next;
    for (const Wall& w : walls) {
        if (w.low.y > y || w.high.y < y || !(w.a.y <= p.y && p.y < w.b.y)) continue;
        Offset offset = offsetAt(w, p);
        if (quadAbs(offset.value) <= offset.doubt) next.doubtful = true;
        offset.value *= way;
        if (offset.value < 0 || (passed && !isBehind(offset, *passed))) continue;
        if (next.where && isBehind(offset, *next.where)) continue;
        if (!next.where || isBehind(*next.where, offset)) next.met.clear(), next.where = offset;
        next.met.step(w.left, w.right);
    }
    return next;
}

/// By the nearest walls that change the owner: a corner that the way only touches leaves it as it was.
Answer nearestWall(const std::vector<Wall>& walls, const QuadPoint& p, int way) {
    std::optional<Offset> passed;
    for (;;) {
        const Meeting next = nextMeeting(walls, p, way, passed);
        if (next.doubtful) return {Sought::kDoubtful};
        if (!next.where) return {Sought::kNothing};
        passed = next.where;
        if (next.met.empty()) continue;
        const auto owner = next.met.only(-way);
        return owner ? Answer{Sought::kFound, *owner} : Answer{Sought::kDoubtful};
    }
}

/// All walls no more than `reach_px` behind the nearest whose offset has the sign `way`.
Surplus firstWalls(const std::vector<Wall>& walls, const QuadPoint& p, int way, double reach_px) {
    std::vector<std::pair<QuadReal, const Wall*>> ahead;
    for (const Wall& w : walls) {
        if (!(w.a.y <= p.y && p.y < w.b.y)) continue;
        const QuadReal distance = offsetAt(w, p).value * way;
        if (distance > 0) ahead.emplace_back(distance, &w);
    }
    Surplus met;
    const auto nearest = std::ranges::min_element(ahead);
    for (const auto& [distance, wall] : ahead)
        if (distance <= nearest->first + reach_px) met.step(wall->left, wall->right);
    return met;
}

/// What lies beyond x: the part of the directed edge that is there, by its height within the box.
Rational heightBeyond(exact::Point a, exact::Point b, const exact::Box& box) {
    if (b.y < a.y) return -heightBeyond(b, a, box);
    if (a.y == b.y || std::max(a.x, b.x) < box.high.x) return 0;
    Rational top = std::max(a.y, box.low.y), bottom = std::min(b.y, box.high.y);
    if (std::min(a.x, b.x) < box.high.x) {
        const Rational y = a.y + (box.high.x - a.x) * (b.y - a.y) / (b.x - a.x);
        (a.x < b.x ? top : bottom) = a.x < b.x ? std::max(top, y) : std::min(bottom, y);
    }
    return top < bottom ? bottom - top : Rational(0);
}

exact::Box boxOf(const exact::Region& r) {
    return {{Rational(r.x0), Rational(r.y0)}, {Rational(r.x1), Rational(r.y1)}};
}

}  // namespace

std::vector<Wall> wallsOf(const VisibleMap& map) {
    std::vector<Wall> walls;
    for (const VisibleSegment& s : map.segments)
        walls.push_back(wallBetween(quadPoint(s.a), quadPoint(s.b), s.left, s.right));
    return walls;
}

MapOwners::MapOwners(const VisibleMap& map) : map_(map), walls_(wallsOf(map)), exchanged_(exchanged(walls_)) {
    for (const VisibleSegment& s : map.segments) {
        const exact::Point a = exactPoint(s.a), b = exactPoint(s.b);
        a_.push_back(b.y < a.y ? b : a), b_.push_back(b.y < a.y ? a : b);
    }
}

std::optional<Owner> MapOwners::at(const FinePoint& point) const {
    const QuadPoint p = quadPoint(point), q{p.y, p.x};
    for (const int way : {1, -1})
        if (const Answer answer = nearestWall(walls_, p, way); answer.sought != Sought::kNothing)
            return answer.sought == Sought::kFound ? std::optional(answer.owner) : std::nullopt;
    for (const int way : {1, -1})
        if (const Answer answer = nearestWall(exchanged_, q, way); answer.sought != Sought::kNothing)
            return answer.sought == Sought::kFound ? std::optional(answer.owner) : std::nullopt;
    // Nothing along either axis: the sample row of the point's pixel has its owner there.
    return ownerOnRow(map_, static_cast<int>(std::floor(point.grid.y)), point.grid.x);
}

bool MapOwners::confirmed(const FinePoint& point, Owner owner, bool turned, double reach_px) const {
    const QuadPoint p = quadPoint(point);
    for (const int way : {1, -1}) {
        const Surplus met =
            turned ? firstWalls(exchanged_, {p.y, p.x}, way, reach_px) : firstWalls(walls_, p, way, reach_px);
        if (!met.empty() && met.only(-way) != owner) return false;
    }
    return true;
}

/// The owner at the lower end of the box's right side, just left of it.
std::optional<Owner> MapOwners::ownerRightOf(const exact::Region& region) const {
    const exact::Box box = boxOf(region);
    std::optional<Rational> lowest;
    Surplus met;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
        const exact::Point &a = a_[i], &b = b_[i];
        if (!((a.x < box.high.x) != (b.x < box.high.x))) continue;
        const Rational y = a.y + (box.high.x - a.x) * (b.y - a.y) / (b.x - a.x);
        if (y >= box.high.y || y < box.low.y || (lowest && y < *lowest)) continue;
        if (!lowest || y > *lowest) met.clear(), lowest = y;
        const bool left_is_below = a.x < b.x;  // a -> b goes down or along +x: its left hand is below
        if (left_is_below)
            met.step(walls_[i].right, walls_[i].left);
        else
            met.step(walls_[i].left, walls_[i].right);
    }
    if (!met.empty()) return met.only(1);
    // nothing changes there, or several walls touch the side in one point and leave its owner as it was
    const double middle = (lowest ? static_cast<double>(*lowest) + region.y1 : region.y0 + region.y1) / 2;
    return at({{region.x1, middle}, {-0x1p-76, 0.0}});
}

std::map<Owner, Rational> MapOwners::areas(const exact::Region& region) const {
    const exact::Box box = boxOf(region);
    const Rational width = box.high.x - box.low.x, height = box.high.y - box.low.y;
    std::map<Owner, Rational> areas;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
        const exact::Point &a = a_[i], &b = b_[i];
        Rational part = clampedArea(a, b, box) - width * heightBeyond(a, b, box);
        if ((a.x < box.high.x) != (b.x < box.high.x)) {  // it meets the right side
            const Rational y = a.y + (box.high.x - a.x) * (b.y - a.y) / (b.x - a.x) - box.low.y;
            const Rational along = y < height ? Rational(width * std::max(y, Rational(0))) : Rational(0);
            part += a.x < b.x ? -along : along;
        }
        areas[walls_[i].left] += part, areas[walls_[i].right] -= part;
    }
    if (const auto last = ownerRightOf(region)) areas[*last] += width * height;
    return areas;
}

}  // namespace edgewise::judge
