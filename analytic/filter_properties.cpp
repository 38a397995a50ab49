#include "analytic/filter_properties.h"

#include <algorithm>
#include <cmath>

#include "analytic/gauss_legendre.h"
#include "analytic/kernel_table.h"

namespace edgewise {
namespace {

/// Smooth pieces of at most two oscillations: 32 nodes leave rounding alone.
constexpr int kNodes = 32;
constexpr double kOscillations = 2.0;
/// Scans for roots and maxima, steps a support.
constexpr int kScan = 1024;
constexpr int kOrientations = 8;  ///< Gauss nodes of an eighth of the circle

const GaussRule& rule() {
    static const GaussRule rule = gaussRule(kNodes);
    return rule;
}

template <class F>
double integral(const F& f, double from, double to) {
    double sum = 0.0;
    for (int i = 0; i < kNodes; ++i) sum += rule().weight[i] * f(from + (to - from) * rule().node[i]);
    return (to - from) * sum;
}

template <class F>
double integral(const F& f, double from, double to, double pieces) {
    const int n = std::max(1, static_cast<int>(std::ceil(pieces)));
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        sum += integral(f, from + (to - from) * i / n, from + (to - from) * (i + 1) / n);
    return sum;
}

/// The root between a and b, where f changes sign.
template <class F>
double root(const F& f, double a, double b) {
    const bool rising = f(b) > 0.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (a + b);
        ((f(middle) > 0.0) == rising ? b : a) = middle;
    }
    return 0.5 * (a + b);
}

/// int |f| between two knots: split where f changes sign.
template <class F>
double absoluteIntegral(const F& f, double from, double to) {
    constexpr int kSteps = 64;
    double sum = 0.0, last = from, a = from;
    for (int i = 1; i <= kSteps; ++i) {
        const double b = from + (to - from) * i / kSteps;
        const double inside = 1e-9 * (to - from);  // a knot itself may belong to the next piece
        if (f(a + inside) * f(b - inside) < 0.0) {
            const double zero = root(f, a, b);
            sum += std::abs(integral(f, last, zero));
            last = zero;
        }
        a = b;
    }
    return sum + std::abs(integral(f, last, to));
}

double factor(const Prefilter& filter, double x) {
    return kernelAt(*filter.table, x);
}

/// int_-R^x k
double factorIntegral(const KernelTable& table, double x) {
    if (x <= table.knot.front()) return 0.0;
    if (x >= table.knot.back()) return 1.0;
    const auto above = std::upper_bound(table.knot.begin() + 1, table.knot.end() - 1, x);
    const auto i = static_cast<std::size_t>(above - table.knot.begin() - 1);
    const double u = (x - table.centre[i]) * table.inverse_half[i];
    const auto count = static_cast<std::size_t>(table.k_count) + 1;
    double sum = 0.0;
    for (std::size_t j = count; j-- > 0;) sum = sum * u + table.K[i * count + j];
    return sum;
}

double factorTransform(const Prefilter& filter, const std::vector<double>& knot, double f) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < knot.size(); ++i)
        sum += integral([&](double x) { return factor(filter, x) * std::cos(2 * M_PI * f * x); }, knot[i],
                        knot[i + 1], f * (knot[i + 1] - knot[i]) / kOscillations);
    return sum;
}

double radialTransform(const Prefilter& filter, const std::vector<double>& knot, double f) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < knot.size(); ++i)
        sum += integral([&](double r) { return r * evaluate(filter, r, 0.0) * j0(2 * M_PI * f * r); },
                        knot[i], knot[i + 1], f * (knot[i + 1] - knot[i]) / kOscillations);
    return 2 * M_PI * sum;
}

/// The kernel beyond the line at t in (0, R): the circle of radius r lies there with an angle of 2 acos(t/r),
/// which in v, r = t + v^2, is smooth over octaves of r from t.
double radialTail(const Prefilter& filter, const std::vector<double>& knot, double t) {
    const auto ring = [&](double v) {
        const double r = t + v * v;
        return 2 * v * 2 * r * std::acos(std::min(1.0, t / r)) * evaluate(filter, r, 0.0);
    };
    std::vector<double> cut{0.0};
    for (double r = 2 * t; r < filter.radius; r *= 2) cut.push_back(std::sqrt(r - t));
    for (const double r : knot)
        if (r > t) cut.push_back(std::sqrt(r - t));
    std::sort(cut.begin(), cut.end());
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) sum += integral(ring, cut[i], cut[i + 1]);
    return sum;
}

/// int k(x) K((t - x s)/c) dx, c >= s >= 0.
double separableStep(const Prefilter& filter, double t, double c, double s) {
    const KernelTable& table = *filter.table;
    const double R = table.knot.back();
    if (s < 1e-15) return factorIntegral(table, t / c);
    std::vector<double> cut = table.knot;
    for (const double y : table.knot)
        if (const double x = (t - c * y) / s; std::abs(x) < R) cut.push_back(x);
    std::sort(cut.begin(), cut.end());
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < cut.size(); ++i)
        sum += integral([&](double x) { return factor(filter, x) * factorIntegral(table, (t - x * s) / c); },
                        cut[i], cut[i + 1]);
    return sum;
}

/// Where a Gaussian bends, and the ends.
std::vector<double> radialKnots(const Prefilter& filter) {
    std::vector<double> knot{0.0};
    for (double r = filter.sigma.value_or(filter.radius);
         r < std::min(filter.radius, 40 * filter.sigma.value_or(0)); r += *filter.sigma)
        knot.push_back(r);
    knot.push_back(filter.radius);
    return knot;
}

/// The jump at the border and the changes between, of f on [a, b] by fine steps.
template <class F>
double totalVariation(const F& f, double a, double b) {
    constexpr int kSteps = 4096;
    double sum = 0.0, last = f(a);
    for (int i = 1; i <= kSteps; ++i) {
        const double next = f(a + (b - a) * i / kSteps);
        sum += std::abs(next - last);
        last = next;
    }
    return sum;
}

struct Direction {
    double c, s;  ///< the larger and the smaller of |cos|, |sin|
};
Direction directionOf(double angle) {
    const double x = std::abs(std::cos(angle)), y = std::abs(std::sin(angle));
    return {std::max(x, y), std::min(x, y)};
}

}  // namespace

FilterProperties::FilterProperties(const Prefilter& filter) : filter_(filter) {
    if (!filter_.radial() && !filter_.table)
        filter_.table = std::make_shared<KernelTable>(makeKernelTable(filter_));
    knot_ = filter_.radial() ? radialKnots(filter_) : filter_.table->knot;
    absolute_ = 0.0;
    for (std::size_t i = 0; i + 1 < knot_.size(); ++i)
        absolute_ +=
            filter_.radial()
                ? absoluteIntegral([&](double r) { return 2 * M_PI * r * evaluate(filter_, r, 0.0); },
                                   knot_[i], knot_[i + 1])
                : absoluteIntegral([&](double x) { return factor(filter_, x); }, knot_[i], knot_[i + 1]);
}

double FilterProperties::transform(double f, double angle) const {
    if (filter_.radial()) return radialTransform(filter_, knot_, f);
    return factorTransform(filter_, knot_, f * std::cos(angle)) *
           factorTransform(filter_, knot_, f * std::sin(angle));
}

double FilterProperties::reach(double angle) const {
    const auto [c, s] = directionOf(angle);
    return filter_.radial() ? filter_.radius : filter_.radius * (c + s);
}

double FilterProperties::stepResponse(double t, double angle) const {
    if (t == 0.0) return 0.5;
    if (t < 0.0) return 1.0 - stepResponse(-t, angle);
    if (t >= reach(angle)) return 1.0;
    if (filter_.radial()) return 1.0 - radialTail(filter_, knot_, t);
    const auto [c, s] = directionOf(angle);
    return separableStep(filter_, t, c, s);
}

double FilterProperties::variation(double angle) const {
    const double R = filter_.radius;
    const double inside = std::nextafter(R, 0.0);
    if (filter_.radial()) {
        // int |cos| over the circle is 4; r |W'| dr as sums of r |dW|
        constexpr int kSteps = 4096;
        double sum = R * std::abs(evaluate(filter_, inside, 0.0)), last = evaluate(filter_, 0.0, 0.0);
        for (int i = 1; i <= kSteps; ++i) {
            const double r = i == kSteps ? inside : R * i / kSteps, next = evaluate(filter_, r, 0.0);
            sum += r * std::abs(next - last);
            last = next;
        }
        return 4 * sum;
    }
    const auto k = [&](double x) { return factor(filter_, x); };
    const double one = totalVariation(k, -inside, inside) + 2 * std::abs(k(inside));
    const auto [c, s] = directionOf(angle);
    return (c + s) * one * absolute_;
}

double FilterProperties::negativeArea() const {
    const double whole = filter_.radial() ? absolute_ : absolute_ * absolute_;
    return std::max(0.0, 0.5 * (whole - 1.0));
}

double FilterProperties::secondMoment() const {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < knot_.size(); ++i)
        sum += filter_.radial()
                   ? integral([&](double r) { return M_PI * r * r * r * evaluate(filter_, r, 0.0); },
                              knot_[i], knot_[i + 1])
                   : integral([&](double x) { return x * x * factor(filter_, x); }, knot_[i], knot_[i + 1]);
    return sum;
}

double FilterProperties::overshoot(double angle) const {
    if (negativeArea() < 1e-12) return 0.0;
    const double end = reach(angle), step = end / kScan;
    double best = 0.0;
    for (int i = 1; i < kScan; ++i)
        if (stepResponse(i * step, angle) > stepResponse(best, angle)) best = i * step;
    double a = std::max(0.0, best - step), b = std::min(end, best + step);
    for (int i = 0; i < 60; ++i) {  // S has one maximum between
        const double p = a + (b - a) / 3, q = b - (b - a) / 3;
        const bool rises = stepResponse(p, angle) < stepResponse(q, angle);
        (rises ? a : b) = rises ? p : q;
    }
    return std::max(0.0, stepResponse(0.5 * (a + b), angle) - 1.0);
}

double FilterProperties::edgeWidth(double angle) const {
    const double step = reach(angle) / kScan;
    const auto above = [&](double t) { return stepResponse(t, angle) - 0.9; };
    double t = step;
    while (above(t) < 0.0) t += step;
    return 2 * root(above, t - step, t);
}

double FilterProperties::halfResponse(double angle) const {
    const double step = 1.0 / (64 * filter_.radius);
    const auto below = [&](double f) { return 0.5 - std::abs(transform(f, angle)); };
    double f = step;
    while (below(f) < 0.0) f += step;
    return root(below, f - step, f);
}

EdgeEnergy edgeEnergy(const FilterProperties& properties, double angle) {
    const double limit = kNyquist / directionOf(angle).c;
    // |W^|^2 oscillates with the support's whole extent
    const double extent = 2 * properties.reach(angle);
    const auto pieces = [&](double from, double to) { return (to - from) * extent / kOscillations; };
    constexpr double kScale = 1 / (2 * M_PI * M_PI);
    EdgeEnergy energy;
    energy.blur = kScale * integral(
                               [&](double f) {
                                   const double lost = (1 - properties.transform(f, angle)) / f;
                                   return lost * lost;
                               },
                               0.0, limit, pieces(0.0, limit));
    energy.aliasing = kScale * integral(
                                   [&](double f) {
                                       const double kept = properties.transform(f, angle) / f;
                                       return kept * kept;
                                   },
                                   limit, kEdgeBand, pieces(limit, kEdgeBand));
    energy.share = energy.aliasing * limit / kScale;
    return energy;
}

EdgeEnergy meanEdgeEnergy(const FilterProperties& properties) {
    static const GaussRule rule = gaussRule(kOrientations);
    EdgeEnergy mean;
    for (int i = 0; i < kOrientations; ++i) {
        const EdgeEnergy one = edgeEnergy(properties, 0.25 * M_PI * rule.node[i]);
        mean.blur += rule.weight[i] * one.blur;
        mean.aliasing += rule.weight[i] * one.aliasing;
        mean.share += rule.weight[i] * one.share;
    }
    return mean;
}

}  // namespace edgewise
