// Weights of whole polygons against the kernel integrated over them in two dimensions: no fans, strips, arcs
// or owners.
#include <gtest/gtest.h>

#include <random>

#include "tests/analytic/kernel_truth.h"
#include "tests/analytic/triangle_map.h"

namespace edgewise::test {
namespace {

constexpr std::uint32_t kSeed = 1984;

double grid(double x) {
    return std::round(x * 0x1p32) * 0x1p-32;
}

/// Abscissae where the inner integral is not smooth: corners, and where edges meet a knot line or the circle.
std::vector<Real> kinks(const MapTriangle& t, glm::dvec2 s, const KernelTruth& kernel) {
    std::vector<Real> y = kernel.knots;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 p = t.p[i] - s, e = t.p[(i + 1) % 3] - t.p[i];
        y.push_back(p.y);
        for (Real knot : kernel.knots)
            if (e.x != 0) y.push_back(p.y + e.y * (knot - p.x) / e.x);
        const Real aa = Real(e.x) * e.x + Real(e.y) * e.y, b = Real(p.x) * e.x + Real(p.y) * e.y,
                   c = Real(p.x) * p.x + Real(p.y) * p.y - kernel.R * kernel.R, root = b * b - aa * c;
        for (Real side : {-1, 1})
            if (root > 0) y.push_back(p.y + e.y * (-b + side * std::sqrt(root)) / aa);
    }
    return y;
}

/// The kernel over the row y of the triangle.
Integral rowIntegral(const MapTriangle& t, glm::dvec2 s, const KernelTruth& kernel, Real y) {
    const Real half =
        kernel.f.radial() ? std::sqrt(std::max(Real(0), (kernel.R - y) * (kernel.R + y))) : kernel.R;
    Real low = half, high = -half;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 p = t.p[i] - s, q = t.p[(i + 1) % 3] - s;
        if ((p.y > y) == (q.y > y)) continue;
        const Real x = p.x + (Real(q.x) - p.x) * (y - p.y) / (Real(q.y) - p.y);
        low = std::min(low, x);
        high = std::max(high, x);
    }
    low = std::max(low, -half);
    high = std::min(high, half);
    if (!(low < high)) return {};
    std::vector<Real> cuts = kernel.knots;
    if (!kernel.f.radial()) {
        Integral sum = integrateCut([&](Real x) { return kernel(x); }, low, high, cuts, 1);
        const Real k = kernel(y);
        return {sum.value * k, sum.error * std::abs(k)};
    }
    for (Real scale = std::abs(y); scale > 0 && scale < kernel.R; scale *= 2)
        cuts.insert(cuts.end(), {scale, -scale});
    return integrateCut([&](Real x) { return kernel(std::sqrt(x * x + y * y)); }, low, high, cuts, 1);
}

/// Gauss-Legendre after y = middle + half sin(pi u / 2), which smooths the square roots at a circle's ends.
Integral triangleIntegral(const MapTriangle& t, glm::dvec2 s, const KernelTruth& kernel) {
    std::vector<Real> cuts = kinks(t, s, kernel);
    std::sort(cuts.begin(), cuts.end());
    Integral sum;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const Real a = std::max(cuts[i], -kernel.R), b = std::min(cuts[i + 1], kernel.R),
                   middle = (a + b) / 2, half = (b - a) / 2;
        if (!(half > 0)) continue;
        Real row_error = 0;
        const auto row = [&](Real u) {
            const Integral inner = rowIntegral(t, s, kernel, middle + half * std::sin(Real(M_PIl) / 2 * u));
            row_error = std::max(row_error, inner.error);
            return inner.value * half * std::cos(Real(M_PIl) / 2 * u) * Real(M_PIl) / 2;
        };
        const Integral part = integrate(row, -1, 1, 2);
        sum.value += part.value;
        sum.error += part.error + row_error * (b - a);
    }
    return sum;
}

TEST(PolygonWeights, TrianglesMatchTheirIntegralInTwoDimensions) {
    std::printf("seed %u\n", kSeed);
    for (const char* name : {"box", "disk", "tent", "cone", "gaussian", "gaussian-separable", "bspline",
                             "mitchell", "catmull-rom", "lanczos", "poly:1,-2,1"}) {
        const Prefilter filter = makePrefilter(name, {}, {});
        const KernelTruth kernel(filter);
        PixelWeights weights(filter);
        std::mt19937 random(kSeed);
        std::uniform_real_distribution<double> place(-1.6 * filter.radius, 1.6 * filter.radius);
        const glm::dvec2 s{12.5, 7.5};
        Real worst = 0, reported = 0;
        int partial = 0, whole = 0;
        for (int round = 0; round < 30; ++round) {
            MapTriangle t{{}, 5};
            for (glm::dvec2& p : t.p) p = s + glm::dvec2(grid(place(random)), grid(place(random)));
            const auto pixel = weightsOf(weights, filter.radius, {t}, segmentsOf({t}), s, 1)[0];
            const double got = pixel.count(5) ? toDouble(pixel.at(5)) : 0;
            const Integral exact = triangleIntegral(t, s, kernel);
            partial += got != 0 && std::abs(got) < 0.9;
            whole += ownerAt({t}, s) == 5;
            reported = std::max(reported, exact.error);
            worst = std::max(worst, std::abs(got - exact.value) - exact.error);
        }
        std::printf(
            "%-20s worst %6.2Lf u beyond the quadrature's own %8.2Lf u, %d partial, %d over the sample\n",
            name, worst * 0x1p53L, reported * 0x1p53L, partial, whole);
        EXPECT_LE(worst, 3 * 16 * 0x1p-53L) << name;  // three edges of 16 u
        EXPECT_LE(reported, 0x1p-38L) << name;
        EXPECT_GT(partial, 20) << name;
        EXPECT_GT(whole, 0) << name;
    }
}

}  // namespace
}  // namespace edgewise::test
