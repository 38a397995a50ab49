#include "tests/studies/term_bounds/adversarial_edges.h"

#include <algorithm>
#include <cmath>

#include "analytic/screen_triangle.h"

namespace edgewise::study {
namespace {

using witness::Dice;
using Vec = glm::dvec2;

constexpr double kHard = 0x1p-15;
constexpr double kFarthestPx = 0x1p18;

double cross(Vec a, Vec b) {
    return a.x * b.y - a.y * b.x;
}
double size(Vec p) {
    return std::hypot(p.x, p.y);
}
double maxNorm(Vec p) {
    return std::max(std::abs(p.x), std::abs(p.y));
}
Vec unit(Dice& dice) {
    return witness::unitVector(dice.uniform(-M_PI, M_PI));
}
Vec normalOf(Vec d) {
    return {d.y, -d.x};
}
double tiny(Dice& dice) {
    return smallNumber(dice, 3, 45);
}
double signedTiny(Dice& dice) {
    return dice.coin() ? tiny(dice) : -tiny(dice);
}
/// Up to three steps of the grid.
Vec steps(Dice& dice) {
    return {dice.integer(-3, 3) * kGridPx, dice.integer(-3, 3) * kGridPx};
}

/// Half of the edges that would leave the support are pulled in.
Vec pulledIn(Vec a, Vec b, double R, Dice& dice) {
    if (dice.coin()) return b;
    for (int i = 0; i < 8 && size(b) > R; ++i) b = a + (b - a) * dice.uniform(0.3, 0.9);
    return b;
}

Edge throughSample(const HardSpots& s, Dice& dice) {
    const Vec d = unit(dice), a = onGrid(dice.uniform(0.01, 1) * s.R * d);
    const Vec b = -double(dice.integer(1, 2)) * a;
    if (dice.integer(0, 3) == 0) return {a, b};
    return {a, onGrid(b + signedTiny(dice) * s.R * normalOf(d)) + (dice.coin() ? steps(dice) : Vec(0))};
}

Edge vertexAtSample(const HardSpots& s, Dice& dice) {
    const Vec a = dice.integer(0, 7) == 0 ? Vec(0) : onGrid(tiny(dice) * s.R * unit(dice));
    const Vec b = a + dice.uniform(0.05, 1.5) * s.R * unit(dice);
    return {a, onGrid(pulledIn(a, b, s.R, dice))};
}

Edge tangentToDisk(const HardSpots& s, Dice& dice) {
    const Vec d = unit(dice), n = normalOf(d);
    const double off = signedTiny(dice), chord = std::sqrt(2 * std::abs(off)) * s.R;
    const double reach = dice.coin() ? chord : dice.uniform(0, 1) * s.R;
    const Vec foot = s.R * (1 - off) * n;
    return {onGrid(foot + dice.uniform(-1, 1) * reach * d), onGrid(foot + dice.uniform(-1, 1) * reach * d)};
}

Edge tangentToSquare(const HardSpots& s, Dice& dice) {
    const double side = dice.coin() ? s.R : -s.R;
    if (dice.integer(0, 3) == 0) {  // by a corner
        const double other = dice.coin() ? s.R : -s.R;
        const Vec d = unit(dice), corner(side, other);
        const Vec foot = corner + signedTiny(dice) * s.R * normalOf(d);
        return {onGrid(foot - dice.uniform(0, 2) * s.R * d), onGrid(foot + dice.uniform(0, 2) * s.R * d)};
    }
    Vec a(side * (1 + signedTiny(dice)), dice.uniform(-1.5, 1.5) * s.R);
    Vec b(side * (1 + signedTiny(dice)), dice.uniform(-1.5, 1.5) * s.R);
    if (dice.coin()) std::swap(a.x, a.y), std::swap(b.x, b.y);
    return {onGrid(a), onGrid(b)};
}

Edge farAndLong(const HardSpots& s, Dice& dice) {
    const Vec d = unit(dice);
    const double h = dice.coin() ? dice.uniform(-1, 1) : signedTiny(dice);
    const auto far = [&] { return std::min(s.R * std::exp2(dice.uniform(6, 18)), kFarthestPx); };
    const double from = dice.integer(0, 3) == 0 ? dice.uniform(-1, 1) * s.R : -far();
    return {onGrid(h * s.R * normalOf(d) + from * d), onGrid(h * s.R * normalOf(d) + far() * d)};
}

Edge tinyEdge(const HardSpots& s, Dice& dice) {
    const double at = dice.coin() ? dice.uniform(0, 0.99) : tiny(dice);
    const Vec a = onGrid(at * s.R * unit(dice));
    return {a,
            onGrid(a + smallNumber(dice, 7, 32) * s.R * unit(dice)) + (dice.coin() ? steps(dice) : Vec(0))};
}

Edge nearRadial(const HardSpots& s, Dice& dice) {
    const Vec d = unit(dice), n = normalOf(d);
    const double r = smallNumber(dice, 0, 20) * s.R;
    const Vec a = onGrid(r * d + signedTiny(dice) * r * n);
    const Vec b = a + dice.uniform(0.01, 1.2) * s.R * (d + signedTiny(dice) * n);
    return {a, onGrid(pulledIn(a, b, s.R, dice))};
}

double anyKnot(const HardSpots& s, Dice& dice) {
    return s.knots[static_cast<std::size_t>(dice.integer(0, static_cast<int>(s.knots.size()) - 1))];
}

Edge axisParallel(const HardSpots& s, Dice& dice) {
    const double level = dice.coin() ? anyKnot(s, dice) : dice.uniform(-1, 1) * s.R;
    const double tilt = dice.integer(0, 2) == 0 ? 0.0 : signedTiny(dice);
    const double from = dice.uniform(-1.2, 1.2) * s.R, to = dice.uniform(-1.2, 1.2) * s.R;
    Vec a(from, level), b(to, level + tilt * s.R);
    if (dice.coin()) std::swap(a.x, a.y), std::swap(b.x, b.y);
    return {onGrid(a), onGrid(b)};
}

Edge endOnBorder(const HardSpots& s, Dice& dice) {
    const Vec d = unit(dice);
    const Vec border = s.radial ? s.R * d : s.R / maxNorm(d) * d;
    const Vec corner(dice.coin() ? s.R : -s.R, dice.coin() ? s.R : -s.R);
    const Vec at = !s.radial && dice.integer(0, 3) == 0 ? corner : border;
    const Vec a = onGrid(at) + (dice.coin() ? steps(dice) : Vec(0));
    const Vec along = normalOf(d) * (dice.coin() ? 1.0 : -1.0);
    const Vec way = dice.coin() ? along - signedTiny(dice) * d : unit(dice);
    return {a, onGrid(a + smallNumber(dice, -1, 12) * s.R * way)};
}

Edge endOnKnot(const HardSpots& s, Dice& dice) {
    const Vec at = s.radial ? anyKnot(s, dice) * unit(dice) : Vec(anyKnot(s, dice), anyKnot(s, dice));
    const Vec a = onGrid(at) + (dice.coin() ? steps(dice) : Vec(0));
    if (!s.radial && dice.integer(0, 3) == 0)
        return {a, onGrid(Vec(anyKnot(s, dice), anyKnot(s, dice))) + steps(dice)};
    const Vec b = a + (dice.coin() ? smallNumber(dice, 5, 32) : dice.uniform(0.01, 1)) * s.R * unit(dice);
    return {a, onGrid(pulledIn(a, b, s.R, dice))};
}

Edge attempt(Category category, const HardSpots& s, Dice& dice) {
    switch (category) {
        case Category::kThroughSample:
            return throughSample(s, dice);
        case Category::kVertexAtSample:
            return vertexAtSample(s, dice);
        case Category::kTangent:
            return s.radial ? tangentToDisk(s, dice) : tangentToSquare(s, dice);
        case Category::kFarAndLong:
            return farAndLong(s, dice);
        case Category::kTiny:
            return tinyEdge(s, dice);
        case Category::kNearRadial:
            return nearRadial(s, dice);
        case Category::kAxisParallel:
            return axisParallel(s, dice);
        case Category::kEndOnBorder:
            return endOnBorder(s, dice);
        default:
            return endOnKnot(s, dice);
    }
}

double lineDistance(const Edge& e, Vec p) {
    return std::abs(cross(e.a - p, e.b - p)) / size(e.b - e.a);
}

/// Within 2^-15 R, or the three steps that edges are moved by.
double nearness(const HardSpots& s) {
    return std::max(kHard * s.R, 5 * kGridPx);
}

bool nearKnot(const HardSpots& s, Vec p) {
    const auto on = [&](double x) {
        return std::any_of(s.knots.begin(), s.knots.end(),
                           [&](double knot) { return std::abs(x - knot) <= nearness(s); });
    };
    return s.radial ? on(size(p)) : on(p.x) && on(p.y);
}

bool nearBorder(const HardSpots& s, Vec p) {
    return std::abs((s.radial ? size(p) : maxNorm(p)) - s.R) <= nearness(s);
}

bool isTangent(const HardSpots& s, const Edge& e) {
    if (s.radial) return std::abs(lineDistance(e, Vec(0)) - s.R) <= nearness(s);
    for (const double x : {-s.R, s.R})
        for (const double y : {-s.R, s.R})
            if (lineDistance(e, {x, y}) <= nearness(s)) return true;
    return nearBorder(s, e.a) && nearBorder(s, e.b);
}

}  // namespace

const char* nameOf(Category category) {
    constexpr std::array<const char*, kCategories> kNames = {
        "through sample", "vertex at sample", "tangent",       "far and long", "tiny",
        "near radial",    "axis parallel",    "end on border", "end on knot"};
    return kNames[static_cast<std::size_t>(category)];
}

glm::dvec2 onGrid(glm::dvec2 p) {
    return {std::nearbyint(p.x / kGridPx) * kGridPx, std::nearbyint(p.y / kGridPx) * kGridPx};
}

double smallNumber(witness::Dice& dice, double from, double to) {
    return std::exp2(-dice.uniform(from, to));
}

HardSpots::HardSpots(const EdgeKernel& kernel, const Prefilter& filter)
    : R(filter.radius), radial(filter.radial()) {
    if (!radial) {
        knots = kernel.table->knot;
        return;
    }
    knots = {R, R / 2, kernel.lanes.inner_radius};
    for (double scale = 0.5; filter.sigma && scale <= 3 && scale * *filter.sigma < R; scale *= 2)
        knots.push_back(scale * *filter.sigma);
}

Edge makeEdge(Category category, const HardSpots& spots, witness::Dice& dice) {
    for (;;) {
        const Edge edge = attempt(category, spots, dice);
        if (edge.a != edge.b) return edge;
    }
}

bool isHard(Category category, const HardSpots& s, const Edge& e) {
    const Vec d = e.b - e.a;
    switch (category) {
        case Category::kThroughSample:
            return lineDistance(e, Vec(0)) <= nearness(s);
        case Category::kVertexAtSample:
            return std::min(size(e.a), size(e.b)) <= nearness(s);
        case Category::kTangent:
            return isTangent(s, e);
        case Category::kFarAndLong:
            return size(d) >= 32 * s.R;
        case Category::kTiny:
            return size(d) <= nearness(s);
        case Category::kNearRadial:
            return lineDistance(e, Vec(0)) <= std::max(kHard * size(e.a), 5 * kGridPx) &&
                   e.a.x * d.x + e.a.y * d.y > 0;
        case Category::kAxisParallel:
            return std::min(std::abs(d.x), std::abs(d.y)) <= std::max(kHard * maxNorm(d), 5 * kGridPx);
        case Category::kEndOnBorder:
            return nearBorder(s, e.a) || nearBorder(s, e.b);
        default:
            return nearKnot(s, e.a) || nearKnot(s, e.b);
    }
}

}  // namespace edgewise::study
