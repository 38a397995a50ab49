#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "analytic/exact/gauss_legendre.h"
#include "analytic/exact/separable_factor.h"
#include "tests/studies/term_bounds/screens.h"

namespace edgewise::study {
namespace {

using boost::math::constants::pi;
using exact::Real;

/// Through the oracle's factor at this many points an interval: of a Gaussian over 2 sigma it is off by less
/// than 2^-85 of its peak, of a Lanczos over 1 px by less.
constexpr int kPoints = 32;
/// Coefficients this far below the largest are left out.
const Real kNegligible("1e-26");

/// In powers of u in [-1, 1], by Newton's divided differences.
std::vector<Wide> interpolated(const std::function<Real(const Real&)>& f) {
    std::vector<Real> u(kPoints), newton(kPoints), c(kPoints, Real(0));
    for (int i = 0; i < kPoints; ++i) {
        u[i] = cos(pi<Real>() * (Real(i) + Real(0.5)) / kPoints);
        newton[i] = f(u[i]);
    }
    for (int order = 1; order < kPoints; ++order)
        for (int i = kPoints - 1; i >= order; --i)
            newton[i] = (newton[i] - newton[i - 1]) / (u[i] - u[i - order]);
    for (int i = kPoints - 1; i >= 0; --i) {
        for (int k = kPoints - 1; k > 0; --k) c[k] = c[k - 1] - u[i] * c[k];
        c[0] = newton[i] - u[i] * c[0];
    }
    Real largest = 0;
    for (const Real& x : c) largest = std::max(largest, Real(abs(x)));
    while (c.size() > 1 && abs(c.back()) <= kNegligible * largest) c.pop_back();
    std::vector<Wide> out;
    for (const Real& x : c) out.push_back(wideFrom(x));
    return out;
}

struct Interval {
    Wide left, right, centre, inverse_half;
    std::vector<Wide> density, mass;
    Wide unitOf(Wide x) const { return (x - centre) * inverse_half; }
};

std::vector<Interval> intervalsOf(const exact::SeparableFactor& factor) {
    std::vector<Interval> out;
    const std::vector<Real>& knot = factor.knots();
    for (std::size_t i = 0; i + 1 < knot.size(); ++i) {
        const Real centre = (knot[i] + knot[i + 1]) / 2, half = (knot[i + 1] - knot[i]) / 2;
        const auto at = [&](const Real& u) { return Real(centre + half * u); };
        out.push_back({wideFrom(knot[i]), wideFrom(knot[i + 1]), wideFrom(centre), wideFrom(Real(1 / half)),
                       interpolated([&](const Real& u) { return factor.density(i, at(u)); }),
                       interpolated([&](const Real& u) { return factor.mass(i, at(u)); })});
    }
    return out;
}

class StripScreen : public Truth<Wide> {
  public:
    explicit StripScreen(const Prefilter& filter) : intervals_(intervalsOf(exact::SeparableFactor(filter))) {
        std::size_t degree = 0;
        for (const Interval& i : intervals_) degree = std::max(degree, i.density.size() + i.mass.size() - 2);
        // exact for polynomials; over a cell of entire kernels 20 nodes leave less than 14 do in
        // GaussianScreen
        const exact::GaussRule& rule = exact::gaussRule(std::min(20, static_cast<int>(degree / 2 + 1)));
        for (std::size_t q = 0; q < rule.node.size(); ++q) {
            node_.push_back(wideFrom(Real((1 + rule.node[q]) / 2)));
            weight_.push_back(wideFrom(Real(rule.weight[q] / 2)));
        }
    }

    Wide total(const Edge& e) const override {
        const Wide ends = mass(e.b.x) * mass(e.b.y) - mass(e.a.x) * mass(e.a.y);
        return ends - byParts(e);
    }

    Wide piece(const Edge&, double, double) const override { return 0.0; }
    Wide position(glm::dvec2 p) const override { return mass(p.y); }

  private:
    /// The interval that holds x; -1 left of the support, intervals_.size() right of it.
    int intervalOf(Wide x) const {
        if (x < intervals_.front().left) return -1;
        for (std::size_t i = 0; i < intervals_.size(); ++i)
            if (x < intervals_[i].right) return static_cast<int>(i);
        return static_cast<int>(intervals_.size());
    }

    Wide massIn(int i, Wide x) const {
        if (i < 0) return 0.0;
        if (i >= static_cast<int>(intervals_.size())) return 1.0;
        const Interval& in = intervals_[static_cast<std::size_t>(i)];
        return polynomial(in.mass, in.unitOf(x));
    }

    Wide mass(Wide x) const { return massIn(intervalOf(x), x); }

    /// int k(x) K(y) dx along s in [0, 1], cut at the knots of both axes.
    Wide byParts(const Edge& e) const {
        const Wide ex = exactDifference(e.b.x, e.a.x), ey = exactDifference(e.b.y, e.a.y);
        if (ex.v.hi == 0) return 0.0;
        std::vector<Wide> cuts{0.0, 1.0};
        const auto cut = [&](Wide knot, double from, Wide along) {
            if (along.v.hi == 0) return;
            const Wide s = (knot - Wide(from)) / along;
            if (s > 0.0 && s < 1.0) cuts.push_back(s);
        };
        for (const Interval& i : intervals_) cut(i.left, e.a.x, ex), cut(i.left, e.a.y, ey);
        cut(intervals_.back().right, e.a.x, ex), cut(intervals_.back().right, e.a.y, ey);
        std::sort(cuts.begin(), cuts.end());
        Wide sum = 0.0;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) sum += cellPart(e, ex, ey, cuts[i], cuts[i + 1]);
        return sum * ex;
    }

    Wide cellPart(const Edge& e, Wide ex, Wide ey, Wide from, Wide to) const {
        const Wide step = to - from, middle = (from + to) * 0.5;
        const int column = intervalOf(Wide(e.a.x) + middle * ex), row = intervalOf(Wide(e.a.y) + middle * ey);
        if (column < 0 || column >= static_cast<int>(intervals_.size()) || row < 0) return 0.0;
        const Interval& in = intervals_[static_cast<std::size_t>(column)];
        Wide sum = 0.0;
        for (std::size_t q = 0; q < node_.size(); ++q) {
            const Wide s = from + step * node_[q];
            const Wide density = polynomial(in.density, in.unitOf(Wide(e.a.x) + s * ex));
            sum += weight_[q] * density * massIn(row, Wide(e.a.y) + s * ey);
        }
        return sum * step;
    }

    std::vector<Interval> intervals_;
    std::vector<Wide> node_, weight_;
};

}  // namespace

std::unique_ptr<Truth<Wide>> makeStripScreen(const Prefilter& filter) {
    return std::make_unique<StripScreen>(filter);
}

}  // namespace edgewise::study
