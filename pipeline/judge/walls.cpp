#include "pipeline/judge/walls.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "analytic/fine_point.h"

namespace edgewise::judge {
namespace {

QuadReal quad(const exact::Rational& value) {
    const double high = static_cast<double>(value);
    return QuadReal(high) + static_cast<double>(exact::Rational(value - high));
}

FineCoordinate fineNear(QuadReal value) {
    const double high = static_cast<double>(value);
    return fineCoordinate(0.0, {high, static_cast<double>(value - high)});
}

/// The ordinates where a wall enters or leaves the box sideways: a slab between borders sees what lies in the
/// box on its middle ordinate.
void addSideCrossings(const Wall& w, const exact::Region& box, std::vector<QuadReal>& ordinates) {
    for (const QuadReal x : {QuadReal(box.x0), QuadReal(box.x1)})
        if ((w.a.x < x) != (w.b.x < x))
            ordinates.push_back(w.a.y + (w.b.y - w.a.y) * ((x - w.a.x) / (w.b.x - w.a.x)));
}

std::vector<QuadReal> slabBorders(const std::vector<Wall>& walls, const exact::Region& box) {
    std::vector<QuadReal> borders = {box.y0, box.y1};
    for (const Wall& w : walls) {
        borders.insert(borders.end(), {w.a.y, w.b.y});
        addSideCrossings(w, box, borders);
    }
    std::erase_if(borders, [&](QuadReal y) { return y < box.y0 || y > box.y1; });
    std::sort(borders.begin(), borders.end());
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
    return borders;
}

/// Where a wall runs through a slab.
struct Through {
    QuadReal top, middle, bottom;  ///< abscissae
};

/// What runs through the slab from y0 to y1, from left to right.
std::vector<Through> wallsThrough(const std::vector<const Wall*>& open, QuadReal y0, QuadReal y1) {
    std::vector<Through> through;
    for (const Wall* w : open) {
        const QuadReal top = abscissa(*w, y0), bottom = abscissa(*w, y1);
        through.push_back({top, (top + bottom) / 2, bottom});
    }
    std::sort(through.begin(), through.end(),
              [](const Through& p, const Through& q) { return p.middle < q.middle; });
    return through;
}

void visitSlab(const std::vector<Through>& through, const exact::Region& box, QuadReal y,
               const std::function<void(const Chord&)>& visit) {
    const QuadReal x0 = box.x0, x1 = box.x1;
    for (std::size_t i = 0; i <= through.size(); ++i) {
        const Through* before = i > 0 ? &through[i - 1] : nullptr;
        const Through* after = i < through.size() ? &through[i] : nullptr;
        Chord chord{y, x0, x1, x1 - x0, i};
        if (before) chord.x0 = std::max(x0, before->middle);
        if (after) chord.x1 = std::min(x1, after->middle);
        if (before && after)
            chord.widest =
                std::min(chord.widest, std::max(after->top - before->top, after->bottom - before->bottom));
        if (chord.x0 < chord.x1) visit(chord);
    }
}

/// Doubles of the guard band are off by at most 2^-33 px each.
bool surelyFarther(const Wall& w, double x, double y, double radius) {
    const double reach = radius + 0x1p-31;
    return w.low.y > y + reach || w.high.y < y - reach || w.low.x > x + reach || w.high.x < x - reach;
}

QuadReal squaredDistance(const Wall& w, const QuadPoint& p) {
    const QuadReal ex = w.b.x - w.a.x, ey = w.b.y - w.a.y, dx = p.x - w.a.x, dy = p.y - w.a.y;
    const QuadReal length = ex * ex + ey * ey, along = ex * dx + ey * dy, across = ex * dy - ey * dx;
    if (along <= 0) return dx * dx + dy * dy;
    if (along < length) return across * across / length;
    return (p.x - w.b.x) * (p.x - w.b.x) + (p.y - w.b.y) * (p.y - w.b.y);
}

}  // namespace

QuadPoint quadPoint(const FinePoint& p) {
    return {QuadReal(p.grid.x) + p.rest.x, QuadReal(p.grid.y) + p.rest.y};
}

QuadPoint quadPoint(const exact::Point& p) {
    return {quad(p.x), quad(p.y)};
}

FinePoint finePointNear(const QuadPoint& p) {
    return finePoint(fineNear(p.x), fineNear(p.y));
}

exact::Point exactPoint(const FinePoint& p) {
    using exact::Rational;
    return {Rational(p.grid.x) + Rational(p.rest.x), Rational(p.grid.y) + Rational(p.rest.y)};
}

Wall wallBetween(const QuadPoint& a, const QuadPoint& b, Owner left, Owner right) {
    const glm::dvec2 p{static_cast<double>(a.x), static_cast<double>(a.y)},
        q{static_cast<double>(b.x), static_cast<double>(b.y)};
    const glm::dvec2 low = glm::min(p, q), high = glm::max(p, q);
    return b.y < a.y ? Wall{b, a, right, left, low, high} : Wall{a, b, left, right, low, high};
}

QuadReal abscissa(const Wall& wall, QuadReal y) {
    return wall.a.x + (wall.b.x - wall.a.x) * ((y - wall.a.y) / (wall.b.y - wall.a.y));
}

void forChords(const std::vector<Wall>& walls, const exact::Region& box,
               const std::function<void(const Chord&)>& visit) {
    std::vector<const Wall*> by_top, open;
    for (const Wall& w : walls)
        if (w.a.y < w.b.y && w.b.y > box.y0 && w.a.y < box.y1) by_top.push_back(&w);
    std::sort(by_top.begin(), by_top.end(), [](const Wall* p, const Wall* q) { return p->a.y < q->a.y; });
    const std::vector<QuadReal> borders = slabBorders(walls, box);
    for (std::size_t slab = 0, next = 0; slab + 1 < borders.size(); ++slab) {
        const QuadReal y0 = borders[slab], y1 = borders[slab + 1];
        std::erase_if(open, [&](const Wall* w) { return w->b.y <= y0; });
        for (; next < by_top.size() && by_top[next]->a.y <= y0; ++next) open.push_back(by_top[next]);
        visitSlab(wallsThrough(open, y0, y1), box, (y0 + y1) / 2, visit);
    }
}

bool clearOf(const std::vector<Wall>& walls, const QuadPoint& p, double radius) {
    const double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
    return std::ranges::none_of(walls, [&](const Wall& w) {
        return !surelyFarther(w, x, y, radius) && squaredDistance(w, p) < QuadReal(radius) * radius;
    });
}

std::vector<Wall> exchanged(const std::vector<Wall>& walls) {
    std::vector<Wall> out;
    for (const Wall& w : walls) out.push_back(wallBetween({w.a.y, w.a.x}, {w.b.y, w.b.x}, w.right, w.left));
    return out;
}

exact::Region exchanged(const exact::Region& box) {
    return {box.y0, box.x0, box.y1, box.x1};
}

}  // namespace edgewise::judge
