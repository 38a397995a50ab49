// First moments of polygons against the kernel integrated over them in two dimensions.
#include "analytic/first_moments.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "tests/analytic/kernel_truth.h"
#include "tests/analytic/triangle_map.h"

namespace edgewise::test {
namespace {

constexpr std::uint32_t kSeed = 1687;

struct Moment {
    std::array<Real, 2> value{0, 0};
    Real error = 0;  ///< what the quadrature says of itself
};

double grid(double x) {
    return std::round(x * 0x1p32) * 0x1p-32;
}

/// The row of the triangle at y, cut to the support.
std::pair<Real, Real> rowOf(const MapTriangle& t, glm::dvec2 s, const KernelTruth& kernel, Real y) {
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
    return {std::max(low, -half), std::min(high, half)};
}

/// Ordinates where the rows' integral is not smooth.
std::vector<Real> kinks(const MapTriangle& t, glm::dvec2 s, const KernelTruth& kernel) {
    std::vector<Real> y = kernel.knots;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec2 p = t.p[i] - s, e = t.p[(i + 1) % 3] - t.p[i];
        y.push_back(p.y);
        for (Real knot : {-kernel.R, kernel.R})
            if (e.x != 0) y.push_back(p.y + e.y * (knot - p.x) / e.x);
        const Real aa = glm::dot(e, e), b = glm::dot(p, e), c = glm::dot(p, p) - kernel.R * kernel.R,
                   root = b * b - aa * c;
        for (Real side : {-1, 1})
            if (root > 0) y.push_back(p.y + e.y * (-b + side * std::sqrt(root)) / aa);
    }
    std::sort(y.begin(), y.end());
    return y;
}

/// int (x, y) W over the part of the row inside the triangle.
Moment rowMoment(const MapTriangle& t, glm::dvec2 s, const KernelTruth& kernel, Real y) {
    const auto [low, high] = rowOf(t, s, kernel, y);
    if (!(low < high)) return {};
    const auto W = [&](Real x) {
        return kernel.f.radial() ? kernel(std::sqrt(x * x + y * y)) : kernel(x) * kernel(y);
    };
    std::vector<Real> cuts{0};
    for (Real scale = std::abs(y); scale > 0 && scale < kernel.R; scale *= 2)
        cuts.insert(cuts.end(), {scale, -scale});
    const Integral x = integrateCut([&](Real at) { return at * W(at); }, low, high, cuts, 1);
    const Integral one = integrateCut(W, low, high, cuts, 1);
    return {{x.value, y * one.value}, x.error + std::abs(y) * one.error};
}

/// int (x, y) W over the triangle, in units of R.
Moment momentTruth(const MapTriangle& t, glm::dvec2 s, const KernelTruth& kernel) {
    const std::vector<Real> cuts = kinks(t, s, kernel);
    Moment sum;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const Real a = std::max(cuts[i], -kernel.R), b = std::min(cuts[i + 1], kernel.R);
        const Real middle = (a + b) / 2, half = (b - a) / 2, turn = Real(M_PIl) / 2;
        if (!(half > 0)) continue;
        for (int k = 0; k < 2; ++k) {
            Real row_error = 0;
            const auto row = [&](Real u) {  // the sine smooths the circle's square roots
                const Moment m = rowMoment(t, s, kernel, middle + half * std::sin(turn * u));
                row_error = std::max(row_error, m.error);
                return m.value[k] * half * std::cos(turn * u) * turn;
            };
            const Integral part = integrate(row, -1, 1, 1);
            sum.value[k] += part.value / kernel.R;
            sum.error += (part.error + row_error * (b - a)) / kernel.R;
        }
    }
    return sum;
}

glm::dvec2 momentOf(const FirstMoments& moments, const std::vector<MapSegment>& segments, Owner owner,
                    glm::dvec2 sample) {
    glm::dvec2 sum(0.0);
    for (const MapSegment& s : segments) {
        const glm::dvec2 m = moments.moment(s.segment, s.line, sample);
        if (s.segment.left == owner) sum += m;
        if (s.segment.right == owner) sum -= m;
    }
    return sum;
}

struct Case {
    const char* name;
    std::optional<double> radius, sigma;
};
const Case kMeasures[] = {{"disk", 1.5, {}},       {"cone", 2.0, {}},      {"gaussian", 2.0, {}},
                          {"gaussian", 2.0, 0.05}, {"gaussian", 2.0, 1e5}, {"poly:1,-2,1", 2.0, {}},
                          {"poly:1,1,3", 1.0, {}}, {"box", 0.5, {}},       {"box", 3.0, {}}};

TEST(FirstMoments, AgreeWithQuadratureInThePlane) {
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> side(-1, 1);
    std::size_t inside = 0, beyond = 0, slivers = 0;
    for (const Case& c : kMeasures) {
        const Prefilter measure = makePrefilter(c.name, c.radius, c.sigma);
        const FirstMoments moments(measure);
        const KernelTruth kernel(measure);
        double worst = 0.0, quadrature = 0.0;
        for (int i = 0; i < 24; ++i) {
            const double reach = measure.radius * (i % 3 == 0 ? 0.7 : (i % 3 == 1 ? 2.0 : 20.0));
            MapTriangle t{{}, 5};
            for (glm::dvec2& p : t.p)
                p = {grid(10.5 + reach * side(random)), grid(7.5 + reach * side(random))};
            if (i % 4 == 3)
                t.p[2] = {grid(t.p[1].x + 1e-3 * side(random)), grid(t.p[1].y + 1e-3 * side(random))};
            if (i % 8 == 0) t.p[1].y = t.p[0].y;  // a horizontal edge
            const glm::dvec2 sample(10.5, 7.5);
            const glm::dvec2 got = momentOf(moments, segmentsOf({t}), 5, sample);
            const Moment expected = momentTruth(t, sample, kernel);
            for (int k = 0; k < 2; ++k) {
                const double difference = double(std::fabs(got[k] - expected.value[k]));
                worst = std::max(worst, difference);
                // a line's distance errs by 3 u of the way to its origin, at most 60 R here
                EXPECT_LE(difference, 3 * 60 * 0x1p-53 + double(expected.error)) << c.name << " " << i;
            }
            quadrature = std::max(quadrature, double(expected.error));
            inside += i % 3 == 0, beyond += i % 3 == 2, slivers += i % 4 == 3;
        }
        std::printf("seed %u: %s %g %g: worst %.1e R, the quadrature's own error up to %.1e\n", kSeed, c.name,
                    measure.radius, measure.sigma.value_or(0), worst, quadrature);
        EXPECT_LT(quadrature, 1e-9) << "the comparison would be worth nothing";
    }
    EXPECT_GT(inside, 50u);
    EXPECT_GT(beyond, 50u);
    EXPECT_GT(slivers, 50u);
}

TEST(FirstMoments, NeighboursCancelAndWholePixelsDoNotShow) {
    const FirstMoments moments(makePrefilter("gaussian", {}, {}));
    const MapSegment s = segmentBetween({2.125, 1.75}, {4.5, 5.25}, 0);
    const MapSegment moved = segmentBetween({4098.125, -1022.25}, {4100.5, -1018.75}, 0);
    const glm::dvec2 m = moments.moment(s.segment, s.line, {3.5, 3.5});
    EXPECT_NE(m, glm::dvec2(0.0));
    EXPECT_EQ(moments.moment(moved.segment, moved.line, {4099.5, -1020.5}), m);
    EXPECT_EQ(moments.moment(s.segment, s.line, {13.5, 3.5}), glm::dvec2(0.0));
}

TEST(FirstMoments, TheMeasureIsNowhereNegative) {
    const auto nameOf = [](const char* filter) {
        return centroidMeasure(makePrefilter(filter, {}, {})).name;
    };
    for (const char* kept :
         {"disk", "cone", "gaussian", "poly:1,-2,1", "poly:1,-6,15,-20,15,-6,1", "poly:1,0.5"})
        EXPECT_EQ(nameOf(kept), kept);
    for (const char* separable : {"box", "tent", "gaussian-separable", "bspline", "mitchell", "lanczos"})
        EXPECT_EQ(nameOf(separable), "box");
    EXPECT_EQ(nameOf("poly:1,-1.5"), "disk");
    EXPECT_EQ(centroidMeasure(makePrefilter("lanczos", {}, {})).radius, 3.0);
}

}  // namespace
}  // namespace edgewise::test
