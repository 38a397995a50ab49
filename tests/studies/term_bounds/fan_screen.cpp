#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "analytic/exact/gauss_legendre.h"
#include "tests/studies/term_bounds/screens.h"

namespace edgewise::study {
namespace {

using boost::math::constants::pi;
using exact::Real;

/// The edge's line from the sample: p(t) = h (d.y, -d.x) + t d. Products of ends are exact.
struct Foot {
    Wide h, ta, tb;
};

Wide cross(glm::dvec2 a, glm::dvec2 b) {
    return exactProduct(a.x, b.y) - exactProduct(a.y, b.x);
}

Foot footOf(const Edge& e) {
    const Wide ex = exactDifference(e.b.x, e.a.x), ey = exactDifference(e.b.y, e.a.y);
    const Wide length = sqrt(ex * ex + ey * ey);
    const auto along = [&](glm::dvec2 p) { return (Wide(p.x) * ex + Wide(p.y) * ey) / length; };
    return {cross(e.a, e.b) / length, along(e.a), along(e.b)};
}

/// The angle in turns that a piece of the line shows at the sample.
Wide turnsOfPiece(Wide h, Wide t1, Wide t2) {
    return turnsOf(h * (t2 - t1), h * h + t1 * t2);
}

class FanScreen : public Truth<Wide> {
  public:
    explicit FanScreen(const Prefilter& filter) : radius_(filter.radius) {}

    Wide total(const Edge& e) const override {
        const Foot f = footOf(e);
        if (f.h.v.hi == 0) return 0.0;
        const Wide c = sqrt((radius_ - abs(f.h)) * (radius_ + abs(f.h)));
        const Wide from = f.ta < -c ? -c : f.ta, to = f.tb < c ? f.tb : c;
        if (!(from < to)) return turnsOfPiece(f.h, f.ta, f.tb);
        Wide sum = inside(f.h, from, to);
        if (f.ta < from) sum += turnsOfPiece(f.h, f.ta, from);
        if (to < f.tb) sum += turnsOfPiece(f.h, to, f.tb);
        return sum;
    }

    Wide piece(const Edge& e, double t1, double t2) const override {
        const Wide h = footOf(e).h;
        return h.v.hi == 0 || !(t1 < t2) ? Wide(0.0) : inside(h, t1, t2);
    }

    Wide position(glm::dvec2 p) const override { return turnsOf(p.y, p.x); }

  protected:
    /// h int g dt, h != 0, from < to.
    virtual Wide inside(Wide h, Wide from, Wide to) const = 0;
    const Wide radius_;
};

/// g in powers of (r/R)^2, multiplied out in t.
class PolyScreen : public FanScreen {
  public:
    PolyScreen(const Prefilter& filter, const std::vector<double>& c) : FanScreen(filter) {
        Real whole = 0;
        for (std::size_t k = 0; k < c.size(); ++k) whole += pi<Real>() * c[k] / Real(k + 1);
        for (std::size_t k = 0; k < c.size(); ++k)
            g_.push_back(wideFrom(Real(c[k] / (Real(2 * k + 2) * whole * filter.radius))));
    }

  private:
    /// int (h^2 + t^2)^k dt = sum over j of C(k, j) h^(2k - 2j) [t^(2j + 1)]/(2j + 1), lengths in R.
    Wide inside(Wide h, Wide from, Wide to) const override {
        const Wide hs = h / radius_, h2 = hs * hs, a = from / radius_, b = to / radius_;
        std::vector<Wide> moment, power;
        Wide pa = a, pb = b, ph = 1.0, sum = 0.0;
        for (std::size_t j = 0; j < g_.size(); ++j) {
            moment.push_back((pb - pa) / Wide(2.0 * double(j) + 1));
            power.push_back(ph);
            pa = pa * a * a, pb = pb * b * b, ph = ph * h2;
        }
        for (std::size_t k = 0; k < g_.size(); ++k) {
            double binomial = 1;
            for (std::size_t j = 0; j <= k; ++j) {
                sum += g_[k] * Wide(binomial) * power[k - j] * moment[j];
                binomial = binomial * double(k - j) / double(j + 1);
            }
        }
        return h * sum;
    }

    std::vector<Wide> g_;
};

/// g = 3/(pi R^2) (1/2 - r/(3R)); int r dt = ([t r] + h^2 [asinh(t/|h|)])/2.
class ConeScreen : public FanScreen {
  public:
    explicit ConeScreen(const Prefilter& filter)
        : FanScreen(filter), scale_(wideFrom(Real(3 / (pi<Real>() * filter.radius * filter.radius)))) {}

  private:
    Wide inside(Wide h, Wide from, Wide to) const override {
        const Wide r1 = sqrt(h * h + from * from), r2 = sqrt(h * h + to * to);
        const Wide of_r = ((to * r2 - from * r1) + h * h * asinhDifference(h, from, r1, to, r2)) * 0.5;
        return h * scale_ * ((to - from) * 0.5 - of_r / (radius_ * 3.0));
    }

    static Wide asinhDifference(Wide h, Wide t1, Wide r1, Wide t2, Wide r2) {
        const Wide u1 = r1 + abs(t1), u2 = r2 + abs(t2);
        const bool back1 = t1.v.hi < 0, back2 = t2.v.hi < 0;
        if (back1 && !back2) return log(u2 / abs(h)) + log(u1 / abs(h));
        return back1 ? log(u1 / u2) : log(u2 / u1);
    }

    Wide scale_;
};

/// g = phi(v)/(4 pi sigma^2 N), v = r^2/(2 sigma^2), over stretches of at most 1.5 sigma; where v > 75, e^-v
/// is below 2^-108 and the term is an angle.
class GaussianScreen : public FanScreen {
  public:
    GaussianScreen(const Prefilter& filter, double sigma)
        : FanScreen(filter), sigma_(sigma), twice_(Wide(sigma) * Wide(sigma) * 2.0) {
        const Real R = filter.radius, s = sigma, whole = 1 - exp(-R * R / (2 * s * s));
        scale_ = wideFrom(Real(1 / (4 * pi<Real>() * s * s * whole)));
        inverse_whole_ = wideFrom(Real(1 / whole));
        const exact::GaussRule& rule = exact::gaussRule(kNodes);
        for (int i = 0; i < kNodes; ++i) {
            node_[i] = wideFrom(Real((1 + rule.node[i]) / 2));
            weight_[i] = wideFrom(Real(rule.weight[i] / 2));
        }
    }

  private:
    static constexpr int kNodes = 14;  // on 1.5 sigma: the bound of [E9], at rho = 13, is below 2^-80
    static constexpr double kStretch = 1.5, kFarV = 75;

    Wide inside(Wide h, Wide from, Wide to) const override {
        const Wide c = sqrt(twice_ * kFarV - h * h);
        const Wide t1 = from < -c ? -c : from, t2 = to < c ? to : c;
        if (!(t1 < t2)) return turnsOfPiece(h, from, to) * inverse_whole_;
        Wide sum = h * near(h, t1, t2);
        if (from < t1) sum += turnsOfPiece(h, from, t1) * inverse_whole_;
        if (t2 < to) sum += turnsOfPiece(h, t2, to) * inverse_whole_;
        return sum;
    }

    Wide near(Wide h, Wide from, Wide to) const {
        const double parts = std::ceil(double(to - from) / (kStretch * sigma_));
        const Wide step = (to - from) / Wide(std::max(1.0, parts)), h2 = h * h;
        Wide sum = 0.0;
        for (double i = 0; i < parts; i += 1) {
            const Wide start = from + step * i;
            for (int q = 0; q < kNodes; ++q) {
                const Wide t = start + step * node_[q];
                sum += weight_[q] * onePhi((h2 + t * t) / twice_);
            }
        }
        return sum * step * scale_;
    }

    double sigma_;
    Wide twice_, scale_, inverse_whole_;
    std::array<Wide, kNodes> node_, weight_;
};

}  // namespace

std::unique_ptr<Truth<Wide>> makeFanScreen(const Prefilter& filter) {
    if (filter.kind == KernelKind::kCone) return std::make_unique<ConeScreen>(filter);
    if (filter.kind == KernelKind::kGaussian) return std::make_unique<GaussianScreen>(filter, *filter.sigma);
    return std::make_unique<PolyScreen>(
        filter, filter.kind == KernelKind::kDisk ? std::vector<double>{1.0} : filter.poly);
}

std::unique_ptr<Truth<Wide>> makeScreen(const Prefilter& filter) {
    return filter.radial() ? makeFanScreen(filter) : makeStripScreen(filter);
}

}  // namespace edgewise::study
