#include "tests/witness/kernels.h"

#include <cmath>
#include <numbers>

namespace edgewise::witness {
namespace {

using Profile = std::function<Real(Real)>;

Real sinc(Real t) {
    const Real angle = std::numbers::pi_v<Real> * t;
    return angle == 0 ? 1 : std::sin(angle) / angle;
}

/// The cubic of Mitchell and Netravali 1988, equation 8, for t in units of half the support's half width.
Real cubic(Real t, Real b, Real c) {
    t = std::fabs(t);
    if (t < 1) return ((12 - 9 * b - 6 * c) * t * t * t + (-18 + 12 * b + 6 * c) * t * t + (6 - 2 * b)) / 6;
    if (t >= 2) return 0;
    return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t + (-12 * b - 48 * c) * t + (8 * b + 24 * c)) /
           6;
}

Kernel separable(const Prefilter& filter, Profile profile, std::vector<Real> knots) {
    return {filter.name,      false, filter.radius,
            std::move(knots), false, [profile](Real x, Real y) { return profile(x) * profile(y); }};
}

Kernel radial(const Prefilter& filter, Profile of_squared_distance, bool apex) {
    return {
        filter.name,   true,
        filter.radius, {},
        apex,          [of_squared_distance](Real x, Real y) { return of_squared_distance(x * x + y * y); }};
}

Profile gaussianOfSquare(const Prefilter& filter) {
    const Real radius = filter.radius;
    const Real sigma = filter.sigma ? Real(*filter.sigma) : radius / 3;
    return [sigma](Real squared) { return std::exp(-squared / (2 * sigma * sigma)); };
}

Profile polyOfSquare(const Prefilter& filter) {
    const Real radius = filter.radius;
    return [radius, c = filter.poly](Real squared) {
        Real sum = 0, power = 1;
        for (double coefficient : c) {
            sum += coefficient * power;
            power *= squared / (radius * radius);
        }
        return sum;
    };
}

}  // namespace

Kernel kernelLike(const Prefilter& filter) {
    const Real R = filter.radius;
    const auto one = [](Real) -> Real { return 1; };
    switch (filter.kind) {
        case KernelKind::kBox:
            return separable(filter, one, {});
        case KernelKind::kDisk:
            return radial(filter, one, false);
        case KernelKind::kTent:
            return separable(filter, [R](Real x) { return 1 - std::fabs(x) / R; }, {0});
        case KernelKind::kCone:
            return radial(
                filter, [R](Real s) { return 1 - std::sqrt(s) / R; }, true);
        case KernelKind::kGaussian:
            return radial(filter, gaussianOfSquare(filter), false);
        case KernelKind::kGaussianSeparable:
            return separable(filter, [g = gaussianOfSquare(filter)](Real x) { return g(x * x); }, {});
        case KernelKind::kCubic:
            return separable(
                filter,
                [R, b = Real(filter.b), c = Real(filter.c)](Real x) { return cubic(2 * x / R, b, c); },
                {-R / 2, 0, R / 2});
        case KernelKind::kLanczos:
            return separable(filter, [R](Real x) { return sinc(x) * sinc(x / R); }, {});
        case KernelKind::kPoly:
            return radial(filter, polyOfSquare(filter), false);
    }
    return {};
}

std::vector<Prefilter> allPrefilters() {
    const auto plain = [](KernelKind kind, const char* name, double radius) {
        Prefilter filter;
        filter.kind = kind;
        filter.name = name;
        filter.radius = radius;
        return filter;
    };
    const auto cubicNamed = [&](const char* name, double b, double c) {
        Prefilter filter = plain(KernelKind::kCubic, name, 2);
        filter.b = b;
        filter.c = c;
        return filter;
    };
    std::vector<Prefilter> all = {plain(KernelKind::kBox, "box", 0.5),
                                  plain(KernelKind::kDisk, "disk", 0.5),
                                  plain(KernelKind::kTent, "tent", 1),
                                  plain(KernelKind::kCone, "cone", 1),
                                  plain(KernelKind::kGaussian, "gaussian", 2),
                                  plain(KernelKind::kGaussianSeparable, "gaussian-separable", 2),
                                  cubicNamed("bspline", 1, 0),
                                  cubicNamed("mitchell", 1.0 / 3, 1.0 / 3),
                                  cubicNamed("catmull-rom", 0, 0.5),
                                  plain(KernelKind::kLanczos, "lanczos", 3),
                                  plain(KernelKind::kPoly, "poly:1,-2,1", 2)};
    all[4].sigma = all[5].sigma = 2.0 / 3;
    all.back().poly = {1, -2, 1};
    return all;
}

}  // namespace edgewise::witness
