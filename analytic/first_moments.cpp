#include "analytic/first_moments.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "analytic/transcendental.h"

namespace edgewise {
namespace {

/// e^-(9.25^2 / 2) < 2^-61: beyond it a Gaussian adds nothing.
constexpr double kGaussianReach = 9.25;

/// Bernstein coefficients of sum c_k q^k on [0, 1] are all >= 0, to within their rounding: then so is W.
bool nowhereNegative(const std::vector<double>& c) {
    const std::size_t n = c.size() - 1;
    for (std::size_t i = 0; i <= n; ++i) {
        double sum = 0.0, size = 0.0, share = 1.0;  // share = binomial(i, k) / binomial(n, k)
        for (std::size_t k = 0; k <= i; ++k) {
            sum += share * c[k], size += std::fabs(share * c[k]);
            if (k < n) share *= double(i - k) / double(n - k);
        }
        const double roundings = 4.0 * double(n) + 4.0;
        if (sum < -roundings * 0x1p-53 * size) return false;
    }
    return true;
}

/// Of c_k / (2k + 2), from k on, the whole being 1.
std::vector<double> suffixSums(const std::vector<double>& c) {
    std::vector<double> sums(c.size());
    double sum = 0.0;
    for (std::size_t k = c.size(); k-- > 0;) sums[k] = sum += c[k] / double(2 * k + 2);
    for (double& s : sums) s /= sum;
    return sums;
}

/// Nodes for parts of up to 3 sigma: |e^-v - e^-V| <= e^(y^2/2) + 1 wherever |Im t| <= y sigma. [E9]
GaussRule gaussianRule(double per_sigma, double inner_v) {
    const double whole = inner_v * f64::phi1(inner_v);  // 1 - e^-V
    const auto growth = [=](double y) { return (std::exp(y * y / 2) + 1) / (2 * M_PI * whole); };
    return gaussRule(nodesNeeded(growth, std::min(kLongestPieceSigmas, 2 * per_sigma), 0x1p-53));
}

/// int (1 - 3 r^2 + 2 r^3) dt along a line at distance h, by the recursions for int r and int r^3. [E18]
double coneIntegral(double h, double t1, double t2) {
    const double h2 = h * h, r1 = std::sqrt(h2 + t1 * t1), r2 = std::sqrt(h2 + t2 * t2), length = t2 - t1;
    const double sum = std::max(r1 + r2, 1e-280), part = std::min(length, sum);
    const auto plus = [&](double r, double t) { return t < 0.0 ? h2 / std::max(r - t, 1e-280) : r + t; };
    const double rest = std::max(plus(r1, t1) + plus(r2, -t2), 1e-280);
    const double inverse = 2.0 * f64::atanhOfParts(part, sum, rest);  // int dt / r
    const double first = 0.5 * ((t2 * r2 - t1 * r1) + h2 * inverse);
    const double third = 0.25 * ((t2 * r2 * r2 * r2 - t1 * r1 * r1 * r1) + 3.0 * h2 * first);
    const double second = length * (h2 + (t1 * t1 + t1 * t2 + t2 * t2) / 3.0);
    return length - 3.0 * second + 2.0 * third;
}

/// The part of t1..t2 where |foot + t d| <= 1.
void clip(double foot, double d, double& t1, double& t2) {
    if (d == 0.0) {
        if (std::fabs(foot) > 1.0) t2 = t1;
        return;
    }
    const double u = (-1.0 - foot) / d, v = (1.0 - foot) / d;
    t1 = std::max(t1, std::min(u, v));
    t2 = std::min(t2, std::max(u, v));
}

double meanSquare(double a, double b) {
    return (a * a + a * b + b * b) / 3.0;
}

/// W = 1/4 on [-1, 1]^2. [E19]
glm::dvec2 boxMoment(double h, double t1, double t2, glm::dvec2 d) {
    const glm::dvec2 foot(h * d.y, -h * d.x);
    clip(foot.x, d.x, t1, t2);
    clip(foot.y, d.y, t1, t2);
    if (!(t1 < t2)) return glm::dvec2(0.0);
    const glm::dvec2 a = foot + t1 * d, b = foot + t2 * d;
    return 0.125 * (t2 - t1) *
           glm::dvec2(d.y * (meanSquare(a.x, b.x) - 1.0), d.x * (1.0 - meanSquare(a.y, b.y)));
}

}  // namespace

Prefilter centroidMeasure(const Prefilter& filter) {
    const bool poly = filter.kind == KernelKind::kPoly;
    if (filter.radial() && !(poly && !nowhereNegative(filter.poly))) return filter;
    return makePrefilter(filter.radial() ? "disk" : "box", filter.radius, {});
}

FirstMoments::FirstMoments(const Prefilter& measure) : radius_(measure.radius), inner_(1.0) {
    switch (measure.kind) {
        case KernelKind::kCone:
            form_ = kConeTerm;
            return;
        case KernelKind::kGaussian:
            form_ = kGaussianTerm;
            per_sigma_ = radius_ / measure.sigma.value_or(radius_ / 3.0);
            inner_ = std::min(1.0, kGaussianReach / per_sigma_);
            inner_v_ = 0.5 * (inner_ * per_sigma_) * (inner_ * per_sigma_);
            rule_ = gaussianRule(per_sigma_ * inner_, inner_v_);
            return;
        case KernelKind::kDisk:
        case KernelKind::kPoly:
            form_ = kPolyTerm;
            suffix_ = suffixSums(measure.kind == KernelKind::kDisk ? std::vector{1.0} : measure.poly);
            rule_ = gaussRule(static_cast<int>(suffix_.size()) + 1);
            return;
        default:
            form_ = kStripTerm;
    }
}

/// Psi = -(e^-v - e^-V) / (2 pi (1 - e^-V)) without the cancellation of small V: e^-v - e^-V is
/// e^-v (V - v) phi1(V - v).
double FirstMoments::gaussianIntegral(const Piece& piece) const {
    const double length = piece.t2 - piece.t1, half = 0.5 * per_sigma_ * per_sigma_;
    const double parts = std::max(1.0, std::ceil(length * per_sigma_ / kLongestPieceSigmas));
    const double step = length / parts, whole = inner_v_ * f64::phi1(inner_v_);
    double sum = 0.0;
    for (double part = 0.0; part < parts; part += 1.0)
        for (int i = 0; i < rule_.count(); ++i) {
            const double t = piece.t1 + step * (part + rule_.node[i]);
            const double v = half * (piece.h * piece.h + t * t), rest = std::max(0.0, inner_v_ - v);
            sum += rule_.weight[i] * f64::expNegative(v) * rest * f64::phi1(rest);
        }
    return -sum * step / (2.0 * M_PI * whole);
}

double FirstMoments::polyIntegral(const Piece& piece) const {
    const double length = piece.t2 - piece.t1;
    double sum = 0.0;
    for (int i = 0; i < rule_.count(); ++i) {
        const double t = piece.t1 + length * rule_.node[i], q = piece.h * piece.h + t * t;
        double g = 0.0;
        for (std::size_t j = suffix_.size(); j-- > 0;) g = g * q + suffix_[j];
        sum += rule_.weight[i] * (1.0 - q) * g;
    }
    return -sum * length / (2.0 * M_PI);
}

double FirstMoments::psiIntegral(const Piece& piece) const {
    if (form_ == kConeTerm) return -coneIntegral(piece.h, piece.t1, piece.t2) / (2.0 * M_PI);
    return form_ == kGaussianTerm ? gaussianIntegral(piece) : polyIntegral(piece);
}

glm::dvec2 FirstMoments::radialMoment(Piece piece, glm::dvec2 d) const {
    const double square = (inner_ - std::fabs(piece.h)) * (inner_ + std::fabs(piece.h));
    if (!(square > 0.0)) return glm::dvec2(0.0);
    const double c = std::sqrt(square);
    piece.t1 = std::max(piece.t1, -c), piece.t2 = std::min(piece.t2, c);
    if (!(piece.t1 < piece.t2)) return glm::dvec2(0.0);
    return psiIntegral(piece) * glm::dvec2(d.y, -d.x);
}

glm::dvec2 FirstMoments::moment(const VisibleSegment& segment, const CarrierLine& line,
                                glm::dvec2 sample_px) const {
    const glm::dvec2 from = sample_px - line.origin, d = line.direction;
    const double h = (line.nx_hi * from.x + line.ny_hi * from.y + line.c_hi) / line.length / radius_;
    const auto along = [&](const FinePoint& p) {
        return (glm::dot(p.grid - sample_px, d) + glm::dot(p.rest, d)) / radius_;
    };
    const Piece piece{h, along(segment.a), along(segment.b)};
    if (form_ == kStripTerm) return boxMoment(piece.h, piece.t1, piece.t2, d);
    return radialMoment(piece, d);
}

}  // namespace edgewise
