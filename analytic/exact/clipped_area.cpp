#include "analytic/exact/clipped_area.h"

#include <algorithm>
#include <utility>

namespace edgewise::exact {

Rational clampedArea(Point a, Point b, const Box& box) {
    const bool turned = b.y < a.y;
    if (turned) std::swap(a, b);
    if (a.y == b.y || b.y <= box.low.y || a.y >= box.high.y) return 0;
    const Rational slope = (b.x - a.x) / (b.y - a.y), width = box.high.x - box.low.x;
    std::vector<Rational> cuts = {std::max(a.y, box.low.y), std::min(b.y, box.high.y)};
    for (const Rational& x : {box.low.x, box.high.x}) {
        if (slope == 0) continue;
        const Rational y = a.y + (x - a.x) / slope;
        if (y > cuts[0] && y < cuts[1]) cuts.push_back(y);
    }
    std::sort(cuts.begin(), cuts.end());
    Rational sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const Rational x = a.x + slope * ((cuts[i] + cuts[i + 1]) / 2 - a.y) - box.low.x;
        sum += (cuts[i + 1] - cuts[i]) * std::clamp(x, Rational(0), width);
    }
    return turned ? -sum : sum;
}

Rational areaWithin(const Face& face, const Box& box) {
    if (face.high.x <= box.low.x || face.low.x >= box.high.x || face.high.y <= box.low.y ||
        face.low.y >= box.high.y)
        return 0;
    Rational sum = 0;
    for (const auto& cycle : face.cycles)
        for (std::size_t i = 0; i < cycle.size(); ++i)
            sum += clampedArea(cycle[i], cycle[(i + 1) % cycle.size()], box);
    return sum;
}

}  // namespace edgewise::exact
