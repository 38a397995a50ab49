#include "tests/witness/scanline_quadrature.h"

#include <cmath>
#include <numbers>

#include "tests/witness/events.h"
#include "tests/witness/scanline.h"

namespace edgewise::witness {
namespace {

constexpr int kNodes = KronrodRule::kNodes;

/// The outer integral of one sample. Its variable t is v for a square, and the angle with v = R sin t for a
/// disk, where the chord R cos t is smooth up to the poles.
class OuterIntegral {
  public:
    OuterIntegral(const LocalScene& scene, const Kernel& kernel, Real tolerance)
        : kernel_(kernel), scanline_(scene), tolerance_(tolerance) {
        sum_.resize(1);  // slot 0 integrates the inner error estimates
        slotOf(kBackground);
        for (const LocalTriangle& t : scene.triangles())
            if (!t.see_through) slotOf(t.owner);
    }

    Judgement over(const std::vector<Real>& ordinates) {
        for (std::size_t k = 0; k + 1 < ordinates.size(); ++k) {
            const Real from = parameter(ordinates[k]), to = parameter(ordinates[k + 1]);
            if (from < to) ++result_.pieces, piece(from, to, 48);
        }
        for (const auto& [owner, slot] : slot_) {
            result_.weight[owner] = sum_[slot].value;
            result_.error = std::max(result_.error, sum_[slot].error);
        }
        result_.error += sum_[0].value + sum_[0].error;
        result_.stacks = scanline_.stacks();
        return result_;
    }

  private:
    using Values = std::vector<Real>;
    const Kernel& kernel_;
    Scanline scanline_;
    Real tolerance_;
    std::map<Owner, std::size_t> slot_;
    std::vector<Estimate> sum_;
    Judgement result_;

    /// Stacks of layers are met as they come.
    std::size_t slotOf(Owner owner) {
        const auto [slot, is_new] = slot_.try_emplace(owner, sum_.size());
        if (is_new) sum_.emplace_back();
        return slot->second;
    }

    Real parameter(Real v) const { return kernel_.disk ? std::asin(v / kernel_.radius) : v; }
    Real span() const { return kernel_.disk ? std::numbers::pi_v<Real> : 2 * kernel_.radius; }

    void piece(Real from, Real to, int depth) {
        const Real middle = (from + to) / 2, half = (to - from) / 2;
        std::array<Values, kNodes> at_node;
        for (int i = 0; i < kNodes; ++i) at_node[i] = scan(middle + half * KronrodRule::get().node[i]);
        for (Values& values : at_node) values.resize(sum_.size(), 0);
        std::vector<Estimate> estimate(sum_.size());
        Real worst = 0;
        for (std::size_t s = 0; s < sum_.size(); ++s) {
            estimate[s] = applyRule([&](int i) { return at_node[i][s]; }, half);
            if (s > 0) worst = std::max(worst, estimate[s].error);
        }
        if (worst <= tolerance_ * (2 * half / span()) + tolerance_ * 0x1p-12L || depth == 0) {
            for (std::size_t s = 0; s < sum_.size(); ++s) sum_[s] += estimate[s];
            return;
        }
        piece(from, middle, depth - 1);
        piece(middle, to, depth - 1);
    }

    /// Every owner's share of one scanline, times dv/dt.
    Values scan(Real t) {
        ++result_.scanlines;
        const Real v = kernel_.disk ? kernel_.radius * std::sin(t) : t;
        const Real half_chord = kernel_.disk ? kernel_.radius * std::cos(t) : kernel_.radius;
        const Real dv_dt = kernel_.disk ? half_chord : 1;
        Values values(sum_.size(), 0);
        for (const Run& run : scanline_.cut(v, half_chord)) {
            const Estimate part = inner(run.u_lo, run.u_hi, v);
            const std::size_t slot = slotOf(run.owner);
            values.resize(sum_.size(), 0);
            values[slot] += part.value * dv_dt;
            values[0] += part.error * dv_dt;
        }
        return values;
    }

    Estimate inner(Real lo, Real hi, Real v) const {
        const Real share = tolerance_ / (4 * kernel_.radius);
        const auto along = [&](Real u) { return kernel_.shape(u, v); };
        Estimate sum;
        const auto upTo = [&](Real cut) {
            if (cut <= lo || cut >= hi) return;
            sum += integrate(along, lo, cut, share / 8);
            lo = cut;
        };
        for (Real knot : kernel_.knots) upTo(knot);
        if (kernel_.apex) upTo(0);
        return sum += integrate(along, lo, hi, share / 8);
    }
};

Judgement integral(const ScreenScene& scene, glm::dvec2 sample_px, const Kernel& kernel, Real tolerance) {
    const LocalScene local(scene, sample_px, kernel.radius);
    return OuterIntegral(local, kernel, tolerance).over(eventOrdinates(local, kernel));
}

}  // namespace

Real Judgement::sum() const {
    Real total = 0;
    for (const auto& [owner, w] : weight) total += w;
    return total;
}

ScanlineQuadrature::ScanlineQuadrature(Kernel kernel, Real accuracy)
    : kernel_(std::move(kernel)), accuracy_(accuracy) {
    const Real size = kernel_.radius * kernel_.radius;
    const Judgement whole = integral({}, {0, 0}, kernel_, accuracy_ * size * 0x1p-10L);
    normaliser_ = {whole.of(kBackground), whole.error};
}

Judgement ScanlineQuadrature::judge(const ScreenScene& scene, glm::dvec2 sample_px) const {
    const Real unit = normaliser_.value;
    Judgement result = integral(scene, sample_px, kernel_, accuracy_ * unit);
    Real largest = 0;
    for (auto& [owner, w] : result.weight) {
        w /= unit;
        largest = std::max(largest, std::fabs(w));
    }
    result.error = (result.error + largest * normaliser_.error) / unit;
    return result;
}

ScreenScene swapAxes(const ScreenScene& scene) {
    ScreenScene swapped = scene;
    std::swap(swapped.anchor_px.x, swapped.anchor_px.y);
    for (DepthPlane& plane : swapped.planes) std::swap(plane.dz_dx, plane.dz_dy);
    for (ScreenTriangle& t : swapped.triangles) {
        for (glm::dvec2& p : t.p_px) std::swap(p.x, p.y);
        std::swap(t.p_px[1], t.p_px[2]);
        std::swap(t.vertex[1], t.vertex[2]);
    }
    return swapped;
}

}  // namespace edgewise::witness
