#include "analytic/edge_integral.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string>

#include "tests/analytic/kernel_truth.h"
#include "tests/analytic/triangle_map.h"

namespace edgewise::test {
namespace {

constexpr std::uint32_t kSeed = 19890731;
constexpr double kU = 0x1p-53;
using Point = glm::dvec2;

struct Edge {
    Point a, b;  // relative to the sample, multiples of 2^-32
};

double grid(double x) { return std::round(x * 0x1p32) * 0x1p-32; }
Point grid(Point p) { return {grid(p.x), grid(p.y)}; }

/// The adversarial categories of the closed forms' study.
const char* const kCategories[] = {"generic", "near centre", "through centre", "tangent", "tiny", "huge", "vertex near centre",
                                   "near radial", "end on circle", "near horizontal", "near vertical"};

class EdgeMaker {
  public:
    EdgeMaker(std::mt19937& random, double R) : random_(random), R_(R) {}

    Edge make(const std::string& category) {
        const double angle = uniform(-M_PI, M_PI);
        const Point d{std::cos(angle), std::sin(angle)}, n{d.y, -d.x};
        const double t = uniform(-R_, R_), len = uniform(0.1, 3) * R_;
        if (category == "generic") return between(uniform(-1, 1) * R_ * n + t * d, d, len);
        if (category == "near centre") return between(small() * R_ * n + t * d, d, len);
        if (category == "through centre") return between(0.0 * n - uniform(0, 1) * R_ * d, d, len, true);
        if (category == "tangent") return between((1 - small()) * R_ * n - 0.5 * len * d, d, len);
        if (category == "tiny") return between(uniform(-0.7, 0.7) * R_ * n + 0.7 * t * d, d, small() * R_);
        if (category == "huge") return between(uniform(-1, 1) * R_ * n - std::exp2(uniform(7, 18)) * d, d, std::exp2(uniform(8, 19)));
        if (category == "vertex near centre") return between(small() * R_ * n, d, len);
        if (category == "near radial") return between(small() * R_ * n + small() * d, d, len);
        if (category == "end on circle") return between(R_ * d, -1.0 * Point(std::cos(angle + uniform(-1, 1)), std::sin(angle)), len);
        const double tilt = small();
        const Point h = category == "near horizontal" ? Point(1, tilt) : Point(tilt, 1);
        return between(Point(t, uniform(-R_, R_)) - len * h, h, 2 * len);
    }

    double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  private:
    double small() { return std::exp2(-uniform(3, 30)); }
    /// Grid points; `centred`: exactly opposite ends, so that the line passes through the sample.
    Edge between(Point a, Point d, double len, bool centred = false) {
        const Point p = grid(a);
        return {p, centred ? -std::round(1 + len) * p : p + grid(len * d)};
    }

    std::mt19937& random_;
    double R_;
};

EdgeTerms termsOf(const EdgeKernel& kernel, Edge edge, EdgeTermsFunction function) {
    const Point sample{1000.5, 517.5};  // on the grid with its ends: the sums are exact
    const MapSegment m = segmentBetween(edge.a + sample, edge.b + sample, 0);
    const VisibleSegment& s = m.segment;
    const CarrierLine& l = m.line;
    EdgeTerms terms{};
    function(kernel.lanes,
             {sample.x, sample.y, s.a.grid.x, s.a.grid.y, 0, 0, s.b.grid.x, s.b.grid.y, 0, 0, s.length, l.origin.x, l.origin.y,
              l.nx_hi, l.nx_lo, l.ny_hi, l.ny_lo, 0, 0, l.length, l.direction.x, l.direction.y},
             terms);
    return terms;
}

__extension__ typedef __float128 Wide;

/// The line in the canonical direction, from exact products.
struct Foot {
    Real h, ta, tb, dx, dy;
    explicit Foot(Edge e) {
        if (e.a.y > e.b.y || (e.a.y == e.b.y && e.a.x < e.b.x)) std::swap(e.a, e.b);
        const Wide ex = Wide(e.b.x) - e.a.x, ey = Wide(e.b.y) - e.a.y;
        const Wide square = ex * ex + ey * ey;
        Wide length = std::sqrt(static_cast<Real>(square));
        for (int i = 0; i < 2; ++i) length = (length + square / length) / 2;
        h = static_cast<Real>((Wide(e.a.x) * e.b.y - Wide(e.a.y) * e.b.x) / length);
        ta = static_cast<Real>((e.a.x * ex + e.a.y * ey) / length);
        tb = static_cast<Real>((e.b.x * ex + e.b.y * ey) / length);
        dx = static_cast<Real>(ex / length);
        dy = static_cast<Real>(ey / length);
    }
};

/// F_in = h int g dt over the part inside the disk, g by quadrature of the kernel's definition.
Integral fanTruth(const KernelTruth& kernel, const Foot& line) {
    const Real R = kernel.R, H = std::abs(line.h);
    if (H >= R) return {};
    const Real c = std::sqrt((R - H) * (R + H));
    const Real t1 = std::max(line.ta, -c), t2 = std::min(line.tb, c);
    if (!(t1 < t2)) return {};
    std::vector<Real> cuts{0};
    for (Real scale = H; scale > 0 && scale < R; scale *= 4) {
        cuts.push_back(scale);
        cuts.push_back(-scale);
    }
    Integral inner = integrateCut([&](Real t) { return kernel.fanDensity(std::sqrt(line.h * line.h + t * t)).value; }, t1, t2,
                                  cuts, 2);
    return {line.h * inner.value, H * inner.error};
}

/// S_in = int K(x) k(y) dy over the part inside the square.
Integral stripTruth(const KernelTruth& kernel, const Foot& line) {
    std::vector<Real> cuts;
    for (Real knot : kernel.knots) {
        if (line.dx != 0) cuts.push_back((knot - line.h * line.dy) / line.dx);
        if (line.dy != 0) cuts.push_back((knot + line.h * line.dx) / line.dy);
    }
    const auto f = [&](Real t) -> Real {
        const Real x = line.h * line.dy + t * line.dx, y = t * line.dy - line.h * line.dx;
        if (x <= -kernel.R || x >= kernel.R || y <= -kernel.R || y >= kernel.R) return 0;
        return kernel.massBelow(x).value * kernel(y);
    };
    const Integral sum = integrateCut(f, line.ta, line.tb, cuts, 1);
    return {line.dy * sum.value, line.dy * sum.error};
}

struct Worst {
    double relative = 0, absolute = 0;
    int met = 0;
};

void measure(const char* name, std::optional<double> radius, std::optional<double> sigma, int edges, bool strip, double bound_u) {
    const Prefilter filter = makePrefilter(name, radius, sigma);
    const EdgeKernel kernel(filter);
    const KernelTruth truth(filter);
    const EdgeTermsFunction function = chooseEdgeTerms();
    std::mt19937 random(kSeed);
    EdgeMaker maker(random, filter.radius);
    std::map<std::string, Worst> all;
    Real reported = 0;
    for (const char* category : kCategories) {
        Worst& worst = all[category];
        for (int i = 0; i < edges; ++i) {
            const Edge edge = maker.make(category);
            if (edge.a == edge.b) continue;
            const Foot line(edge);
            const EdgeTerms terms = termsOf(kernel, edge, function);
            const Integral exact = strip ? stripTruth(truth, line) : fanTruth(truth, line);
            const double error = static_cast<double>(std::abs(Real(terms.value[0]) * 0x1p-60L - exact.value) - exact.error) - 0x1p-61;
            reported = std::max(reported, exact.error);
            worst.met += terms.touched & 1;
            worst.absolute = std::max(worst.absolute, error / kU);
            if (std::abs(exact.value) > 0x1p-8L) worst.relative = std::max(worst.relative, error / static_cast<double>(std::abs(exact.value)) / kU);
        }
    }
    std::printf("%-20s (quadrature reports %.1Lg u)\n", name, reported / kU);
    for (const char* category : kCategories) {
        const Worst& w = all[category];
        std::printf("    %-20s %5d met  %6.2f u absolute  %6.2f u relative above 2^-8\n", category, w.met, w.absolute, w.relative);
        EXPECT_GT(w.met, edges / 20) << name << ", " << category;
        EXPECT_LE(w.absolute, bound_u) << name << ", " << category;
    }
}

TEST(EdgeIntegral, FanTermsMatchQuadrature) {
    std::printf("seed %u\n", kSeed);
    for (const char* name : {"disk", "cone", "gaussian", "poly:1,-2,1"}) measure(name, {}, {}, 200, false, 4);
    measure("gaussian", 2, 2e-3, 60, false, 4);
    measure("gaussian", 2, 200, 60, false, 4);
    measure("gaussian", 4, 0.4, 60, false, 4);
}

TEST(EdgeIntegral, StripTermsMatchQuadrature) {
    for (const char* name : {"box", "tent", "gaussian-separable", "bspline", "mitchell", "catmull-rom", "lanczos"})
        measure(name, {}, {}, 60, true, 16);
    measure("gaussian-separable", 4, 0.25, 40, true, 16);
    measure("lanczos", 1.37, {}, 40, true, 16);
}

}  // namespace
}  // namespace edgewise::test
