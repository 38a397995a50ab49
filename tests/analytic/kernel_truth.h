// The contract's kernels from their definitions in long double, and integrals of them by Gauss-Legendre on
// many parts: nothing here shares code or formulas with analytic/.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "analytic/prefilter.h"

namespace edgewise::test {

using Real = long double;
using Function = std::function<Real(Real)>;

struct Integral {
    Real value = 0, error = 0;  ///< error: the difference of a 20 and a 30 point rule, summed
};

inline Integral integrate(const Function& f, Real from, Real to, int parts) {
    Integral sum;
    for (int i = 0; i < parts; ++i) {
        const Real a = from + (to - from) * i / parts, b = from + (to - from) * (i + 1) / parts;
        const Real fine = boost::math::quadrature::gauss<Real, 30>::integrate(f, a, b);
        sum.value += fine;
        sum.error += std::abs(fine - boost::math::quadrature::gauss<Real, 20>::integrate(f, a, b));
    }
    return sum;
}

/// Integral over [from, to] cut at `cuts`.
inline Integral integrateCut(const Function& f, Real from, Real to, std::vector<Real> cuts, int parts) {
    cuts.push_back(from);
    cuts.push_back(to);
    std::sort(cuts.begin(), cuts.end());
    Integral sum;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const Real a = std::max(cuts[i], from), b = std::min(cuts[i + 1], to);
        if (!(a < b)) continue;
        const Integral part = integrate(f, a, b, parts);
        sum.value += part.value;
        sum.error += part.error;
    }
    return sum;
}

class KernelTruth {
  public:
    explicit KernelTruth(const Prefilter& filter) : f(filter), R(filter.radius) {
        for (int i = -static_cast<int>(std::ceil(R)); i <= std::ceil(R); ++i) knots.push_back(i);
        for (Real knot : {-R, -R / 2, Real(0), R / 2, R}) knots.push_back(knot);
        for (Real scale = 1; f.sigma && scale <= 64; scale *= 2)
            for (Real side : {-1, 1}) knots.push_back(side * scale * *f.sigma);
        if (f.radial())
            total =
                2 * Real(M_PIl) * integrateCut([this](Real r) { return r * shape(r); }, 0, R, knots, 1).value;
        else
            total = integrateCut([this](Real x) { return shape(x); }, -R, R, knots, 1).value;
    }

    /// Radial: W(r). Separable: k(x).
    Real operator()(Real x) const { return shape(x) / total; }

    /// G(r) / r^2 = (1/r^2) int_0^r s W(s) ds.
    Integral fanDensity(Real r) const {
        Integral sum = integrateCut([&](Real s) { return s * (*this)(s); }, 0, r, knots, 1);
        if (r > 0) return {sum.value / (r * r), sum.error / (r * r)};
        return {(*this)(0) / 2, 0};
    }

    Integral massBelow(Real x) const {
        if (x <= -R) return {};
        if (x >= R) return {1, 0};
        return integrateCut(*this, -R, x, knots, 1);
    }

    const Prefilter& f;
    Real R, total = 1;
    std::vector<Real> knots;

  private:
    static Real sinc(Real t) { return t == 0 ? 1 : std::sin(Real(M_PIl) * t) / (Real(M_PIl) * t); }

    Real cubic(Real x) const {
        const Real B = f.b, C = f.c, x2 = x * x, x3 = x2 * x;
        if (x < 1) return (12 - 9 * B - 6 * C) * x3 + (-18 + 12 * B + 6 * C) * x2 + 6 - 2 * B;
        return (-B - 6 * C) * x3 + (6 * B + 30 * C) * x2 + (-12 * B - 48 * C) * x + 8 * B + 24 * C;
    }

    Real shape(Real x) const {
        const Real a = std::abs(x);
        switch (f.kind) {
            case KernelKind::kTent:
            case KernelKind::kCone:
                return 1 - a / R;
            case KernelKind::kGaussian:
            case KernelKind::kGaussianSeparable:
                return std::exp(-a * a / (2 * Real(*f.sigma) * *f.sigma));
            case KernelKind::kCubic:
                return cubic(2 * a / R);
            case KernelKind::kLanczos:
                return sinc(a) * sinc(a / R);
            case KernelKind::kPoly: {
                Real sum = 0;
                for (std::size_t k = f.poly.size(); k-- > 0;) sum = sum * (a / R) * (a / R) + f.poly[k];
                return sum;
            }
            default:
                return 1;
        }
    }
};

}  // namespace edgewise::test
