#include "analytic/edge_integral.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
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

double grid(double x) {
    return std::round(x * 0x1p32) * 0x1p-32;
}
Point grid(Point p) {
    return {grid(p.x), grid(p.y)};
}

/// The adversarial categories of the closed forms' study.
const char* const kCategories[] = {
    "generic",     "near centre",   "through centre",  "tangent",      "tiny", "huge", "vertex near centre",
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
        if (category == "huge")
            return between(uniform(-1, 1) * R_ * n - std::exp2(uniform(7, 18)) * d, d,
                           std::exp2(uniform(8, 19)));
        if (category == "vertex near centre") return between(small() * R_ * n, d, len);
        if (category == "near radial") return between(small() * R_ * n + small() * d, d, len);
        if (category == "end on circle")
            return between(R_ * d, -1.0 * Point(std::cos(angle + uniform(-1, 1)), std::sin(angle)), len);
        const double tilt = small();
        const Point h = category == "near horizontal" ? Point(1, tilt) : Point(tilt, 1);
        return between(Point(t, uniform(-R_, R_)) - len * h, h, 2 * len);
    }

    double uniform(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random_);
    }

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
    const EdgeInput input{
        s.a.grid.x, s.a.grid.y, 0,          0,          s.b.grid.x,    s.b.grid.y,   0,
        0,          s.length,   l.origin.x, l.origin.y, l.nx_hi,       l.nx_lo,      l.ny_hi,
        l.ny_lo,    0,          0,          l.length,   l.direction.x, l.direction.y};
    const EdgePair pair{&input, sample.x, sample.y};
    function(kernel.lanes, &pair, 1, terms);
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

/// What a term and its crossings give the left owner together: F_in + (entry's position) - (exit's position),
/// modulo the border. Moving the point where the segment leaves the support changes both parts by the same
/// amount, so this, and not the term of a clipped segment, is what rounding must leave alone. Crossings are
/// those that the code found.
struct Settled {
    Real value = 0, error = 0;
};

/// F_in = h int g dt over the part inside the disk, g by quadrature of the kernel's definition.
Settled fanTruth(const KernelTruth& kernel, const Foot& line, const EdgeTerms& terms) {
    if (!(terms.touched & 1)) return {};
    const Real R = kernel.R, H = std::abs(line.h);
    const Real c = H < R ? std::sqrt((R - H) * (R + H)) : 0;
    const Real t1 = terms.crossed[0] & 1 ? -c : line.ta, t2 = terms.crossed[1] & 1 ? c : line.tb;
    std::vector<Real> cuts{0};
    for (Real scale = std::max(H, R * 0x1p-40L); scale < R; scale *= 4)
        cuts.insert(cuts.end(), {scale, -scale});
    Real density_error = 0;
    const auto g = [&](Real t) {
        const Integral density = kernel.fanDensity(std::sqrt(line.h * line.h + t * t));
        density_error = std::max(density_error, density.error);
        return density.value;
    };
    const Integral inner = integrateCut(g, t1, t2, cuts, 1);
    Settled settled{line.h * inner.value, H * (inner.error + density_error * 2 * R)};
    const auto turns = [&](Real t) {
        return std::atan2(t * line.dy - line.h * line.dx, line.h * line.dy + t * line.dx) / (2 * Real(M_PIl));
    };
    if (terms.crossed[0] & 1) settled.value += turns(-c);
    if (terms.crossed[1] & 1) settled.value -= turns(c);
    return settled;
}

/// S_in = int K(x) k(y) dy over the part inside the square.
Settled stripTruth(const KernelTruth& kernel, const Foot& line, const EdgeTerms& terms) {
    std::vector<Real> cuts;
    for (Real knot : kernel.knots) {
        if (line.dx != 0) cuts.push_back((knot - line.h * line.dy) / line.dx);
        if (line.dy != 0) cuts.push_back((knot + line.h * line.dx) / line.dy);
    }
    Real mass_error = 0;
    const auto f = [&](Real t) -> Real {
        const Real x = line.h * line.dy + t * line.dx, y = t * line.dy - line.h * line.dx;
        if (x <= -kernel.R || x >= kernel.R || y <= -kernel.R || y >= kernel.R) return 0;
        const Integral mass = kernel.massBelow(x);
        mass_error = std::max(mass_error, mass.error);
        return mass.value * kernel(y);
    };
    const Integral sum = integrateCut(f, line.ta, line.tb, cuts, 1);
    Settled settled{line.dy * sum.value, line.dy * sum.error + mass_error * 2};
    if (!((terms.crossed[0] | terms.crossed[1]) & 1)) return settled;
    const Real t = std::min(std::max((kernel.R - line.h * line.dy) / line.dx, line.ta), line.tb);
    const Real share = kernel.massBelow(t * line.dy - line.h * line.dx).value;
    settled.value += terms.crossed[0] & 1 ? share : -share;
    return settled;
}

Real settledValue(const EdgeTerms& terms) {
    Real value = Real(terms.value[0]);
    if (terms.crossed[0] & 1) value += Real(terms.position[0][0]);
    if (terms.crossed[1] & 1) value -= Real(terms.position[1][0]);
    return value * 0x1p-60L;
}

struct Worst {
    double inside_relative = 0, absolute = 0;
    int met = 0, inside = 0;
};

struct Study {
    const char* name;
    std::optional<double> radius, sigma;
    int edges;
    bool strip;
    Precision precision = Precision::kFp64;
    double u() const { return precision == Precision::kFp32 ? 0x1p-24 : kU; }
};

/// A fixed-point conversion errs by 2^-61: up to three of them are no matter of the formula.
constexpr Real kConversions = 1.5L * 0x1p-60L;

std::map<std::string, Worst> measure(const Study& study, Real& reported) {
    const Prefilter filter = makePrefilter(study.name, study.radius, study.sigma);
    const EdgeKernel kernel(filter, study.precision);
    const KernelTruth truth(filter);
    const EdgeTermsFunction function = chooseEdgeTerms(study.precision);
    std::mt19937 random(kSeed);
    EdgeMaker maker(random, filter.radius);
    std::map<std::string, Worst> all;
    for (const char* category : kCategories) {
        Worst& worst = all[category];
        for (int i = 0; i < study.edges; ++i) {
            const Edge edge = maker.make(category);
            if (edge.a == edge.b) continue;
            const Foot line(edge);
            const EdgeTerms terms = termsOf(kernel, edge, function);
            const Settled exact = study.strip ? stripTruth(truth, line, terms) : fanTruth(truth, line, terms);
            const Real difference = settledValue(terms) - exact.value;
            const Real wrapped = std::abs(difference - std::round(difference));
            const double error = static_cast<double>(wrapped - exact.error - kConversions) / study.u();
            reported = std::max(reported, exact.error);
            worst.met += terms.touched & 1;
            worst.absolute = std::max(worst.absolute, error);
            if (((terms.crossed[0] | terms.crossed[1]) & 1) || !(terms.touched & 1)) continue;
            ++worst.inside;
            worst.inside_relative =
                std::max(worst.inside_relative, error / static_cast<double>(std::abs(exact.value)));
        }
    }
    return all;
}

void check(const Study& study, double relative_bound_u, double absolute_bound_u) {
    Real reported = 0;
    const std::map<std::string, Worst> all = measure(study, reported);
    std::printf("%s, quadrature reports %.2Lg u\n", study.name, reported / kU);
    for (const char* category : kCategories) {
        const Worst& w = all.at(category);
        std::printf("    %-20s %4d met, %6.2f u absolute; %4d wholly inside, %6.2f u relative\n", category,
                    w.met, w.absolute, w.inside, w.inside_relative);
        EXPECT_GT(w.met, study.edges / 20) << study.name << ", " << category;
        EXPECT_LE(w.absolute, absolute_bound_u) << study.name << ", " << category;
        EXPECT_LE(w.inside_relative, relative_bound_u) << study.name << ", " << category;
    }
}

/// The promise of DERIVATIONS.md: 16 u of the term for positive kernels wholly inside, 16 u an edge in all.
constexpr double kRelativeU = 16, kAbsoluteU = 16;

TEST(EdgeIntegral, FanTermsMatchQuadrature) {
    std::printf("seed %u\n", kSeed);
    for (const char* name : {"disk", "cone", "gaussian", "poly:1,-2,1"})
        check({name, {}, {}, 100, false}, kRelativeU, kAbsoluteU);
    for (double sigma : {2e-3, 0.2, 20.0, 200.0})
        check({"gaussian", 2, sigma, 40, false}, kRelativeU, kAbsoluteU);
}

/// The same promise with u = 2^-24. [E21]
TEST(EdgeIntegral, FloatTermsMatchQuadrature) {
    std::printf("seed %u\n", kSeed);
    for (const char* name : {"disk", "cone", "gaussian", "poly:1,-2,1"})
        check({name, {}, {}, 60, false, Precision::kFp32}, kRelativeU, kAbsoluteU);
    for (double sigma : {2e-3, 0.2, 20.0, 200.0})
        check({"gaussian", 2, sigma, 30, false, Precision::kFp32}, kRelativeU, kAbsoluteU);
    constexpr double no_relative = 1e300;  // terms of either sign cancel
    for (const char* name : {"box", "tent", "gaussian-separable", "mitchell", "lanczos"})
        check({name, {}, {}, 20, true, Precision::kFp32}, no_relative, kAbsoluteU);
}

/// Short chords of the circle of 9.25 sigma that reach beyond it at both ends: there the term is the angle
/// over 2 pi to 2^-61, in either form of g, and keeps its relative accuracy although the chord's ends are
/// known to roundings of the radius only.
TEST(EdgeIntegral, ShortChordsOfANarrowGaussiansInnerCircleKeepTheirLength) {
    const EdgeKernel kernel(makePrefilter("gaussian", 2, 0.05));
    const double circle = kernel.lanes.inner_radius;
    std::mt19937 random(kSeed);
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    Real worst = 0;
    int chords = 0;
    for (int i = 0; i < 2000; ++i) {
        const double angle = uniform(-M_PI, M_PI), depth = std::pow(10.0, uniform(-9, -6));
        const double half = std::sqrt(2 * circle * depth);
        const Point d{std::cos(angle), std::sin(angle)}, foot = (circle - depth) * Point{d.y, -d.x};
        const Edge edge{grid(foot - half * uniform(1, 9) * d), grid(foot + half * uniform(1, 9) * d)};
        chords += std::abs(Foot(edge).h) < Real(circle);
        const Wide across = Wide(edge.a.x) * edge.b.y - Wide(edge.a.y) * edge.b.x;
        const Wide along = Wide(edge.a.x) * edge.b.x + Wide(edge.a.y) * edge.b.y;
        const Real turns = std::atan2(std::abs(Real(across)), Real(along)) / (2 * std::numbers::pi_v<Real>);
        const EdgeTerms terms = termsOf(kernel, edge, chooseEdgeTerms());
        ASSERT_FALSE((terms.crossed[0] | terms.crossed[1]) & 1);
        const Real off = std::abs(std::abs(std::ldexp(Real(terms.value[0]), -60)) - turns);
        worst = std::max(worst, (off - 0x1p-61L) / turns / kU);
    }
    std::printf("%d chords, worst %.2Lg u relative\n", chords, worst);
    EXPECT_GT(chords, 1000);
    EXPECT_LE(worst, kRelativeU);
}

TEST(EdgeIntegral, StripTermsMatchQuadrature) {
    const double no_relative = std::numeric_limits<double>::infinity();
    for (const char* name :
         {"box", "tent", "gaussian-separable", "bspline", "mitchell", "catmull-rom", "lanczos"})
        check({name, {}, {}, 40, true}, no_relative, kAbsoluteU);
    check({"gaussian-separable", 4, 0.25, 20, true}, no_relative, kAbsoluteU);
    check({"lanczos", 1.37, {}, 20, true}, no_relative, kAbsoluteU);
    check({"lanczos", 12, {}, 5, true}, no_relative, kAbsoluteU);  // more pieces than a step of rows holds
}

}  // namespace
}  // namespace edgewise::test
