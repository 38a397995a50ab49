#include "analytic/kernel_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "analytic/lane_kernel.h"
#include "analytic/quad_real.h"

namespace edgewise {
namespace {

using Shape = std::function<QuadReal(QuadReal)>;
using Coefficients = std::vector<QuadReal>;

/// What makeKernelTable() needs to know of a factor before it is normalised.
struct Factor {
    Shape shape;
    std::vector<QuadReal> knots;
    int degree = -1;                       ///< of the polynomials, -1: fit
    std::function<double(double)> growth;  ///< |k(x + iy)| <= sup |k| growth(|y|)
};

std::vector<QuadReal> evenKnots(QuadReal from, QuadReal to, int intervals) {
    std::vector<QuadReal> knots;
    for (int i = 0; i <= intervals; ++i) knots.push_back(from + (to - from) * i / intervals);
    return knots;
}

/// The BC family on [-2, 2] (Mitchell and Netravali 1988), times 6.
QuadReal cubicShape(QuadReal x, double b, double c) {
    const QuadReal B = b, C = c;
    x = quadAbs(x);
    if (x < 1) return ((12 - 9 * B - 6 * C) * x + (-18 + 12 * B + 6 * C)) * x * x + (6 - 2 * B);
    return (((-B - 6 * C) * x + (6 * B + 30 * C)) * x + (-12 * B - 48 * C)) * x + (8 * B + 24 * C);
}

QuadReal sinc(QuadReal x) {
    if (quadAbs(x) < QuadReal(0x1p-60)) return 1;
    return quadSinPi(x) / (quadPi() * x);
}

/// Beyond this many sigmas e^(-r^2 / 2 sigma^2) < 2^-61: k is 0 there.
constexpr double kGaussianReach = 9.25;

Factor gaussianFactor(double R, double sigma) {
    const double reach = std::min(R, kGaussianReach * sigma);
    const int intervals = std::max(2, 2 * static_cast<int>(std::ceil(reach / sigma)));
    Factor factor{.shape =
                      [=](QuadReal x) {
                          return quadAbs(x) > reach ? QuadReal(0)
                                                    : quadExp(-x * x / (2 * QuadReal(sigma) * sigma));
                      },
                  .knots = evenKnots(-reach, reach, intervals),
                  .growth = [=](double y) { return std::exp(y * y / (2 * sigma * sigma)); }};
    if (reach < R) {
        factor.knots.insert(factor.knots.begin(), -R);
        factor.knots.push_back(R);
    }
    return factor;
}

Factor lanczosFactor(double R) {
    const int intervals = 2 * static_cast<int>(std::ceil(2 * R));
    const double type =
        M_PI * (1 + 1 / R);  // the product of two sincs is entire of this exponential type, at most 1
    return {.shape = [=](QuadReal x) { return sinc(x) * sinc(x / R); },
            .knots = evenKnots(-R, R, intervals),
            .growth = [=](double y) { return std::exp(type * y); }};
}

Factor factorOf(const Prefilter& f) {
    const double R = f.radius;
    switch (f.kind) {
        case KernelKind::kBox:
            return {[](QuadReal) { return QuadReal(1); }, evenKnots(-R, R, 1), 0, {}};
        case KernelKind::kTent:
            return {[R](QuadReal x) { return 1 - quadAbs(x) / R; }, evenKnots(-R, R, 2), 1, {}};
        case KernelKind::kCubic:
            return {[R, b = f.b, c = f.c](QuadReal x) { return cubicShape(2 * x / R, b, c); },
                    evenKnots(-R, R, 4),
                    3,
                    {}};
        case KernelKind::kGaussianSeparable:
            return gaussianFactor(R, f.sigma.value_or(R / 3));
        case KernelKind::kLanczos:
            return lanczosFactor(R);
        default:
            throw std::logic_error("factorOf: " + f.name + " is not separable");
    }
}

/// The polynomial through degree + 1 Chebyshev points of the interval, in powers of u in [-1, 1].
Coefficients interpolate(const Shape& shape, QuadReal centre, QuadReal half, int degree) {
    const int n = degree + 1;
    std::vector<QuadReal> u(n), newton(n);
    for (int i = 0; i < n; ++i) {
        u[i] = std::cos(M_PI * (i + 0.5) / n);
        newton[i] = shape(centre + half * u[i]);
    }
    for (int order = 1; order < n; ++order)
        for (int i = n - 1; i >= order; --i) newton[i] = (newton[i] - newton[i - 1]) / (u[i] - u[i - order]);
    Coefficients c(n, QuadReal(0));
    for (int i = n - 1; i >= 0; --i) {  // c(u) = c(u) (u - u_i) + newton_i
        for (int k = n - 1; k > 0; --k) c[k] = c[k - 1] - u[i] * c[k];
        c[0] = newton[i] - u[i] * c[0];
    }
    return c;
}

QuadReal polynomial(const Coefficients& c, QuadReal u) {
    QuadReal sum = 0;
    for (std::size_t k = c.size(); k-- > 0;) sum = sum * u + c[k];
    return sum;
}

struct Fit {
    std::vector<Coefficients> pieces;
    QuadReal error = 0, largest = 0, l1 = 0;
};

Fit fitAll(const Factor& factor, int degree) {
    Fit fit;
    for (std::size_t i = 0; i + 1 < factor.knots.size(); ++i) {
        const QuadReal centre = (factor.knots[i] + factor.knots[i + 1]) / 2,
                       half = (factor.knots[i + 1] - factor.knots[i]) / 2;
        fit.pieces.push_back(interpolate(factor.shape, centre, half, degree));
        for (int s = 0; s < 64; ++s) {
            const QuadReal u = (QuadReal(s) + QuadReal(1) / 2) / 32 - 1,
                           exact = factor.shape(centre + half * u);
            fit.error = std::max(fit.error, quadAbs(polynomial(fit.pieces.back(), u) - exact));
            fit.largest = std::max(fit.largest, quadAbs(exact));
            fit.l1 += quadAbs(exact) * half / 32;
        }
    }
    return fit;
}

/// The degree grows until the fit is finer than double.
Fit fitFactor(const Factor& factor) {
    if (factor.degree >= 0) return fitAll(factor, factor.degree);
    for (int degree = 6; degree <= 24; ++degree)
        if (Fit fit = fitAll(factor, degree); fit.error <= fit.largest * QuadReal(0x1p-58)) return fit;
    throw std::logic_error("fitFactor: degree 24 is not enough");
}

/// Beyond a Gaussian's reach k is 0: there the integrand is 0, or K is constant and it varies along y alone.
bool holdsKernel(const KernelTable& table, int interval) {
    const auto first = table.k.begin() + static_cast<std::ptrdiff_t>(interval) * table.k_count;
    return std::any_of(first, first + table.k_count, [](double c) { return c != 0.0; });
}

/// A cell's integrand K(x) k(y) on a line: |K| <= l1 + y sup|k| growth(y).
int cellNodes(const Factor& factor, const KernelTable& table) {
    if (factor.degree >= 0) return factor.degree + 1;
    double width = 0.0;
    for (int i = 0; i < table.intervals(); ++i)
        if (holdsKernel(table, i)) width = std::max(width, 2.0 / table.inverse_half[i]);
    const double length = width * M_SQRT2;
    const auto growth = [&](double y) {
        const double k = table.k_max * factor.growth(y);
        return length * k * (table.l1 + y * k);
    };
    return nodesNeeded(growth, length, 0x1p-62);
}

}  // namespace

KernelTable makeKernelTable(const Prefilter& filter) {
    const Factor factor = factorOf(filter);
    const Fit fit = fitFactor(factor);
    const int intervals = static_cast<int>(fit.pieces.size());
    KernelTable table;
    table.k_count = static_cast<int>(fit.pieces[0].size());
    std::vector<Coefficients> integrals;
    QuadReal total = 0;
    for (int i = 0; i < intervals; ++i) {
        const QuadReal half = (factor.knots[i + 1] - factor.knots[i]) / 2;
        Coefficients K(1, QuadReal(0));
        for (int j = 0; j < table.k_count; ++j) K.push_back(fit.pieces[i][j] * half / (j + 1));
        K[0] = total - polynomial(K, -1);
        total = polynomial(K, 1);
        integrals.push_back(K);
        table.centre.push_back(static_cast<double>((factor.knots[i] + factor.knots[i + 1]) / 2));
        table.inverse_half.push_back(static_cast<double>(1 / half));
    }
    for (QuadReal knot : factor.knots) table.knot.push_back(static_cast<double>(knot));
    for (int i = 0; i < intervals; ++i) {
        for (QuadReal c : fit.pieces[i]) table.k.push_back(static_cast<double>(c / total));
        for (QuadReal c : integrals[i]) table.K.push_back(static_cast<double>(c / total));
    }
    table.k_max = static_cast<double>(fit.largest / quadAbs(total));
    table.l1 = static_cast<double>(fit.l1 / quadAbs(total)) * (1 + 0x1p-10);
    table.fit_error = static_cast<double>(fit.error / fit.largest);
    table.rule = gaussRule(cellNodes(factor, table));
    if (table.rule.count() > kMostCellNodes)
        throw std::logic_error("a kernel's cells take more nodes than terms hold");
    return table;
}

double kernelAt(const KernelTable& table, double x) {
    if (!(std::abs(x) <= table.knot.back())) return 0.0;
    const auto above = std::upper_bound(table.knot.begin() + 1, table.knot.end() - 1, x);
    const std::size_t i = above - table.knot.begin() - 1;
    const double u = (x - table.centre[i]) * table.inverse_half[i];
    double sum = 0.0;
    for (int j = table.k_count; j-- > 0;) sum = sum * u + table.k[i * table.k_count + j];
    return sum;
}

}  // namespace edgewise
