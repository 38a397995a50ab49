#include "pipeline/judge/grid_line.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "analytic/screen_triangle.h"

namespace edgewise::judge {
namespace {

/// x with a x = gcd(a, m) modulo m, by Euclid's extended algorithm; 0 <= x < m.
std::int64_t inverse(std::int64_t a, std::int64_t m) {
    std::int64_t r = m, next_r = a % m, x = 0, next_x = 1;
    while (next_r != 0) {
        const std::int64_t times = r / next_r;
        r = std::exchange(next_r, r - times * next_r);
        x = std::exchange(next_x, x - times * next_x);
    }
    return x < 0 ? x + m : x;
}

}  // namespace

GridDirection pythagorean(std::int64_t m, std::int64_t n) {
    while (std::gcd(m, n) != 1 || ((m ^ n) & 1) == 0) ++m;
    return {m * m - n * n, 2 * m * n, m * m + n * n};
}

/// cross((p, q), (x, y)) = p y - q x = c: y = c / p modulo q's share, so x = -c / q modulo p, then y follows.
std::array<glm::dvec2, 2> lineAtOffset(const GridDirection& d, WideSteps c, double reach_px) {
    WideSteps x = 0;
    if (d.p > 1) {
        const WideSteps rest = ((-c % d.p) + d.p) % d.p;
        x = rest * inverse(d.q % d.p, d.p) % d.p;
    }
    WideSteps y = (c + x * d.q) / d.p;
    const double along = (double(x) * double(d.p) + double(y) * double(d.q)) / (double(d.h) * double(d.h));
    const auto back = static_cast<WideSteps>(std::floor(along));
    x -= back * d.p, y -= back * d.q;
    const auto steps = static_cast<WideSteps>(std::ceil(reach_px / (double(d.h) * kGridPx))) + 1;
    const auto at = [&](WideSteps k) {
        return glm::dvec2(double(x + k * d.p), double(y + k * d.q)) * kGridPx;
    };
    return {at(-steps), at(steps)};
}

}  // namespace edgewise::judge
