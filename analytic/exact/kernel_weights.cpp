#include "analytic/exact/kernel_weights.h"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <functional>
#include <stdexcept>

#include "analytic/exact/clipped_area.h"
#include "analytic/exact/gauss_legendre.h"
#include "analytic/exact/separable_factor.h"

namespace edgewise::exact {
namespace {

using boost::math::constants::pi;
constexpr int kNodes = 40;
const Real kRounding("1e-48");  // a hundred roundings of numbers up to 1 in 50 digits

struct Edge {
    Real ax, ay, bx, by;  ///< from the sample
    Real cross;           ///< of the ends, from exact ones
};

Edge edgeOf(const Point& a, const Point& b, const Point& sample) {
    const Rational ax = a.x - sample.x, ay = a.y - sample.y, bx = b.x - sample.x, by = b.y - sample.y;
    return {Real(ax), Real(ay), Real(bx), Real(by), Real(Rational(ax * by - ay * bx))};
}

/// One rule, and what two halves say of it.
template <class Function>
Weight judgedIntegral(const Real& a, const Real& b, const Function& f) {
    const GaussRule& rule = gaussRule(kNodes);
    const Real whole = gaussIntegral(rule, a, b, f), middle = (a + b) / 2;
    const Real halves = gaussIntegral(rule, a, middle, f) + gaussIntegral(rule, middle, b, f);
    return {halves, abs(halves - whole)};
}

void add(Weight& sum, const Weight& part) {
    sum.value += part.value, sum.error += part.error;
}

}  // namespace

struct KernelWeights::Form {
    virtual ~Form() = default;
    virtual Weight of(const Edge& edge) const = 0;
    virtual Weight piece(const Edge& edge, const Real& t1, const Real& t2) const = 0;
    virtual Weight position(const Real& x, const Real& y) const = 0;
};

namespace {

/// F(a, b) = the integral of the kernel over the signed triangle (sample, a, b)
///         = sum over the parts outside the support of angle/(2 pi) + h int g(r(t)) dt over the part inside,
/// g(r) = G(r)/r^2, G(r) = int_0^r w(s) s ds, along the line at the signed distance h.
class Fan : public KernelWeights::Form {
  public:
    explicit Fan(const Prefilter& filter)
        : radius_(filter.radius), stretch_(2 * radius_), g_(meanOf(filter)) {
        if (filter.kind == KernelKind::kGaussian) stretch_ = Real(*filter.sigma);
        cone_ = filter.kind == KernelKind::kCone;
    }

    Weight of(const Edge& e) const override {
        if (e.cross == 0) return {};
        const Real ex = e.bx - e.ax, ey = e.by - e.ay, length = sqrt(ex * ex + ey * ey);
        const Real h = e.cross / length;
        const Real ta = (e.ax * ex + e.ay * ey) / length, tb = (e.bx * ex + e.by * ey) / length;
        const Real square = radius_ * radius_ - h * h, c = square > 0 ? sqrt(square) : Real(0);
        const Real from = std::max(ta, Real(-c)), to = std::min(tb, c);
        if (from >= to) return {angle(h, ta, tb), kRounding};
        Weight sum = inside(h, from, to);
        if (ta < from) sum.value += angle(h, ta, from);
        if (to < tb) sum.value += angle(h, to, tb);
        return sum;
    }

    Weight piece(const Edge& e, const Real& t1, const Real& t2) const override {
        const Real ex = e.bx - e.ax, ey = e.by - e.ay;
        return e.cross == 0 ? Weight{} : inside(e.cross / sqrt(ex * ex + ey * ey), t1, t2);
    }

    Weight position(const Real& x, const Real& y) const override {
        return {atan2(y, x) / (2 * pi<Real>()), kRounding};
    }

  private:
    static Real angle(const Real& h, const Real& t1, const Real& t2) {
        return atan2(Real(h * (t2 - t1)), Real(h * h + t1 * t2)) / (2 * pi<Real>());
    }

    Weight inside(const Real& h, const Real& from, const Real& to) const {
        if (cone_)
            return {h * (coneIntegral(h, to) - coneIntegral(h, from)),
                    100 * kRounding * abs(h)};  // room for two lost digits
        const auto along = [&](const Real& t) { return h * g_(Real(h * h + t * t)); };
        const int parts = 1 + static_cast<int>(ceil((to - from) / stretch_));
        Weight sum{0, kRounding};
        for (int i = 0; i < parts; ++i)
            add(sum,
                judgedIntegral(from + (to - from) * i / parts, from + (to - from) * (i + 1) / parts, along));
        return sum;
    }

    /// int g dt for g = 3/(pi R^2) (1/2 - r/(3R)), r^2 = h^2 + t^2: of r it is (t r + h^2 asinh(t/|h|))/2.
    Real coneIntegral(const Real& h, const Real& t) const {
        const Real r = sqrt(h * h + t * t);
        const Real of_r = (t * r + h * h * asinh(Real(t / abs(h)))) / 2;
        return 3 / (pi<Real>() * radius_ * radius_) * (t / 2 - of_r / (3 * radius_));
    }

    /// g as a function of r^2.
    static std::function<Real(const Real&)> meanOf(const Prefilter& filter) {
        const Real R = filter.radius;
        if (filter.kind == KernelKind::kGaussian) return gaussianMean(Real(*filter.sigma), R);
        if (filter.kind == KernelKind::kPoly) return polyMean(filter.poly, R);
        return [value = 1 / (2 * pi<Real>() * R * R)](const Real&) { return value; };
    }

    static std::function<Real(const Real&)> gaussianMean(const Real& sigma, const Real& R) {
        const Real twice = 2 * sigma * sigma, whole = 1 - exp(-R * R / twice);
        return [=](const Real& r2) {
            const Real v = r2 / twice;
            Real mean;  // (1 - e^-v)/v
            if (v > Real(1e-4))
                mean = (1 - exp(-v)) / v;
            else {
                mean = 0;  // thirteen terms leave v^13/14! < 1e-62
                for (int k = 13; k >= 1; --k) mean = (1 - v * mean) / k;
            }
            return mean / (2 * pi<Real>() * twice * whole);
        };
    }

    static std::function<Real(const Real&)> polyMean(const std::vector<double>& c, const Real& R) {
        Real whole = 0;
        for (std::size_t k = 0; k < c.size(); ++k) whole += pi<Real>() * R * R * c[k] / Real(k + 1);
        return [=](const Real& r2) {
            Real sum = 0;
            for (std::size_t k = c.size(); k-- > 0;)
                sum = sum * (r2 / (R * R)) + Real(c[k]) / Real(2 * k + 2);
            return sum / whole;
        };
    }

    Real radius_, stretch_;
    bool cone_ = false;
    std::function<Real(const Real&)> g_;
};

/// Green's theorem: w = sum over edges of int K(x) k(y) dy, K from the left side of the square, 1 beyond its
/// right.
class Strip : public KernelWeights::Form {
  public:
    explicit Strip(const Prefilter& filter) : factor_(filter) {}

    Weight of(const Edge& e) const override {
        const Real R = factor_.radius();
        if (e.ay == e.by || std::max(e.ay, e.by) <= -R || std::min(e.ay, e.by) >= R) return {};
        std::vector<Real> cuts = {std::clamp(e.ay, Real(-R), R), std::clamp(e.by, Real(-R), R)};
        const auto cut = [&](const Real& y) {
            if (y > std::min(cuts[0], cuts[1]) && y < std::max(cuts[0], cuts[1])) cuts.push_back(y);
        };
        for (const Real& knot : factor_.knots()) {
            cut(knot);
            if (e.ax != e.bx) cut(e.ay + (e.by - e.ay) * (knot - e.ax) / (e.bx - e.ax));
        }
        std::sort(cuts.begin(), cuts.end());
        Weight sum{0, factor_.error()};
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
            if (cuts[i] < cuts[i + 1]) add(sum, row(e, cuts[i], cuts[i + 1]));
        if (e.by < e.ay) sum.value = -sum.value;
        return sum;
    }

    Weight piece(const Edge&, const Real&, const Real&) const override {
        throw std::logic_error("KernelWeights::ofPiece: pieces are of radial kernels");
    }

    Weight position(const Real&, const Real& y) const override {
        const Real at = std::clamp(y, Real(-factor_.radius()), factor_.radius());
        return {factor_.mass(factor_.intervalOf(at), at), factor_.error()};
    }

  private:
    Weight row(const Edge& e, const Real& y0, const Real& y1) const {
        const Real R = factor_.radius(), middle = (y0 + y1) / 2, slope = (e.bx - e.ax) / (e.by - e.ay);
        const auto abscissa = [&](const Real& y) { return e.ax + slope * (y - e.ay); };
        const Real at = abscissa(middle);
        const std::size_t band = factor_.intervalOf(middle);
        if (at <= -R) return {};
        if (at >= R) return {factor_.mass(band, y1) - factor_.mass(band, y0), 10 * kRounding};
        const std::size_t column = factor_.intervalOf(at);
        return judgedIntegral(y0, y1, [&](const Real& y) {
            return factor_.mass(column, abscissa(y)) * factor_.density(band, y);
        });
    }

    SeparableFactor factor_;
};

bool beyond(const Face& face, const Point& sample, const Rational& radius) {
    return face.high.x <= sample.x - radius || face.low.x >= sample.x + radius ||
           face.high.y <= sample.y - radius || face.low.y >= sample.y + radius;
}

template <class Visit>
void forEdges(const Face& face, const Visit& visit) {
    for (const auto& cycle : face.cycles)
        for (std::size_t i = 0; i < cycle.size(); ++i) visit(cycle[i], cycle[(i + 1) % cycle.size()]);
}

}  // namespace

Rational boxWeight(const Face& face, const Point& sample, const Rational& radius) {
    const Box support{{sample.x - radius, sample.y - radius}, {sample.x + radius, sample.y + radius}};
    return areaWithin(face, support) / (4 * radius * radius);
}

KernelWeights::KernelWeights(const Prefilter& filter) : radius_(filter.radius) {
    if (filter.radial())
        form_ = std::make_unique<Fan>(filter);
    else
        form_ = std::make_unique<Strip>(filter);
}

KernelWeights::~KernelWeights() = default;

Weight KernelWeights::of(const Face& face, const Point& sample) const {
    Weight sum;
    if (beyond(face, sample, radius_)) return sum;
    forEdges(face, [&](const Point& a, const Point& b) { add(sum, ofEdge(a, b, sample)); });
    return sum;
}

Weight KernelWeights::ofEdge(const Point& a, const Point& b, const Point& sample) const {
    return form_->of(edgeOf(a, b, sample));
}

Weight KernelWeights::ofPiece(const Point& a, const Point& b, const Point& sample, const Real& t1,
                              const Real& t2) const {
    return form_->piece(edgeOf(a, b, sample), t1, t2);
}

Weight KernelWeights::position(const Point& p, const Point& sample) const {
    return form_->position(Real(Rational(p.x - sample.x)), Real(Rational(p.y - sample.y)));
}

}  // namespace edgewise::exact
