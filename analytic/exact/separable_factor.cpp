#include "analytic/exact/separable_factor.h"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <functional>

namespace edgewise::exact {
namespace {

using boost::math::constants::pi;
constexpr int kDegree = 63;
const Real kTrimmed("1e-46");  // of a density that is about 1 somewhere, before it is normalised

Real sinc(const Real& t) {
    const Real a = pi<Real>() * t;
    if (abs(a) > Real(1e-8)) return sin(a) / a;
    const Real q = a * a;  // the next term, a^8 / 9!, is below 1e-69
    return 1 - q / 6 * (1 - q / 20 * (1 - q / 42));
}

Real cubic(const Real& b, const Real& c, const Real& t) {
    const Real x = abs(t);
    if (x < 1) return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) /
           6;
}

std::function<Real(const Real&)> shapeOf(const Prefilter& filter) {
    const Real r = filter.radius;
    switch (filter.kind) {
        case KernelKind::kBox:
            return [](const Real&) { return Real(1); };
        case KernelKind::kTent:
            return [r](const Real& x) { return 1 - abs(x) / r; };
        case KernelKind::kCubic:
            return
                [r, b = Real(filter.b), c = Real(filter.c)](const Real& x) { return cubic(b, c, 2 * x / r); };
        case KernelKind::kLanczos:
            return [r](const Real& x) { return sinc(x) * sinc(x / r); };
        default:
            return [s = Real(*filter.sigma)](const Real& x) { return exp(-x * x / (2 * s * s)); };
    }
}

/// The longest stretch over which a series of kDegree surely converges: a few of the kernel's own lengths.
Real stretchOf(const Prefilter& filter) {
    if (filter.kind == KernelKind::kGaussianSeparable) return 2 * Real(*filter.sigma);
    return filter.kind == KernelKind::kLanczos ? Real(1) : Real(filter.radius) / 2;
}

/// cos(pi m / (2 (kDegree + 1))) for every m of a turn.
const std::vector<Real>& cosines() {
    static const std::vector<Real> table = [] {
        std::vector<Real> out;
        for (int m = 0; m < 4 * (kDegree + 1); ++m)
            out.push_back(cos(pi<Real>() * Real(m) / Real(2 * (kDegree + 1))));
        return out;
    }();
    return table;
}

std::vector<Real> chebyshev(const std::function<Real(const Real&)>& f, const Real& a, const Real& b) {
    constexpr int kPoints = kDegree + 1;
    const std::vector<Real>& cosine = cosines();
    std::vector<Real> value;
    for (int i = 0; i < kPoints; ++i) value.push_back(f((a + b) / 2 + (b - a) / 2 * cosine[2 * i + 1]));
    std::vector<Real> series;
    for (int j = 0; j < kPoints; ++j) {
        Real sum = 0;
        for (int i = 0; i < kPoints; ++i) sum += value[i] * cosine[j * (2 * i + 1) % (4 * kPoints)];
        series.push_back(sum * (j == 0 ? 1 : 2) / kPoints);
    }
    return series;
}

/// The antiderivative that vanishes at the left end, over an interval of this length.
std::vector<Real> integrated(const std::vector<Real>& series, const Real& length) {
    const auto at = [&](std::size_t j) { return j < series.size() ? series[j] : Real(0); };
    std::vector<Real> out(series.size() + 1, Real(0));
    for (std::size_t j = 1; j < out.size(); ++j)
        out[j] = length / 2 * ((j == 1 ? 2 * at(0) : at(j - 1)) - at(j + 1)) / (2 * Real(j));
    for (std::size_t j = 1; j < out.size(); ++j) out[0] -= j % 2 == 0 ? out[j] : -out[j];
    return out;
}

/// Without the last coefficients as long as they come to less than `below`: a polynomial's are roundings.
void trim(std::vector<Real>& series, const Real& below) {
    Real dropped = abs(series.back());
    for (; series.size() > 1 && dropped < below; dropped += abs(series.back())) series.pop_back();
}

Real clenshaw(const std::vector<Real>& series, const Real& t) {
    Real next = 0, after = 0;
    for (std::size_t j = series.size() - 1; j > 0; --j) {
        const Real here = 2 * t * next - after + series[j];
        after = next, next = here;
    }
    return t * next - after + series[0];
}

}  // namespace

SeparableFactor::SeparableFactor(const Prefilter& filter) : radius_(filter.radius) {
    const auto shape = shapeOf(filter);
    const Real length = radius_ / ceil(radius_ / stretchOf(filter));
    const int each_side = static_cast<int>(lround(radius_ / length));
    for (int i = -each_side; i <= each_side; ++i) knots_.push_back(radius_ * i / each_side);
    Real whole = 0, left_out = 0;
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
        Series s{chebyshev(shape, knots_[i], knots_[i + 1]), {}, whole};
        for (std::size_t j = kDegree - 3; j <= kDegree; ++j)
            left_out = std::max(left_out, Real(abs(s.density[j])));
        trim(s.density, kTrimmed);
        s.mass = integrated(s.density, knots_[i + 1] - knots_[i]);
        series_.push_back(s);
        whole += clenshaw(s.mass, 1);
    }
    for (Series& s : series_) {
        s.before /= whole;
        for (Real& c : s.density) c /= whole;
        for (Real& c : s.mass) c /= whole;
    }
    error_ = (left_out * 8 + kTrimmed + Real("1e-47")) * 2 * radius_ / abs(whole);
}

Real SeparableFactor::evaluate(const std::vector<Real>& series, std::size_t i, const Real& x) const {
    return clenshaw(series, (2 * x - knots_[i] - knots_[i + 1]) / (knots_[i + 1] - knots_[i]));
}

Real SeparableFactor::density(std::size_t i, const Real& x) const {
    return evaluate(series_[i].density, i, x);
}

Real SeparableFactor::mass(std::size_t i, const Real& x) const {
    return series_[i].before + evaluate(series_[i].mass, i, x);
}

std::size_t SeparableFactor::intervalOf(const Real& x) const {
    const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, x);
    return static_cast<std::size_t>(after - knots_.begin()) - 1;
}

}  // namespace edgewise::exact
