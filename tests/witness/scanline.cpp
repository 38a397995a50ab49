#include "tests/witness/scanline.h"

#include <algorithm>

namespace edgewise::witness {

const std::vector<Run>& Scanline::cut(Real v, Real half_chord) {
    collectSpans(v, half_chord);
    collectBreaks(v, half_chord);
    collectRuns(v);
    return runs_;
}

void Scanline::collectSpans(Real v, Real half_chord) {
    spans_.clear();
    for (std::size_t t = 0; t < scene_.triangles().size(); ++t) {
        const LocalTriangle& triangle = scene_.triangles()[t];
        if (v <= triangle.v_lo || v >= triangle.v_hi) continue;
        Real lo = half_chord, hi = -half_chord;
        for (const Side& side : triangle.side) {
            if (v < side.v_lo || v > side.v_hi || side.v_lo == side.v_hi) continue;
            lo = std::min(lo, side.u(v));
            hi = std::max(hi, side.u(v));
        }
        lo = std::max(lo, -half_chord);
        hi = std::min(hi, half_chord);
        if (lo < hi) spans_.push_back({lo, hi, t});
    }
    std::sort(spans_.begin(), spans_.end(), [](const Span& a, const Span& b) { return a.u_lo < b.u_lo; });
}

void Scanline::collectBreaks(Real v, Real half_chord) {
    breaks_ = {-half_chord, half_chord};
    for (std::size_t k = 0; k < spans_.size(); ++k) {
        breaks_.push_back(spans_[k].u_lo);
        breaks_.push_back(spans_[k].u_hi);
        for (std::size_t l = k + 1; l < spans_.size() && spans_[l].u_lo < spans_[k].u_hi; ++l)
            addDepthBreak(spans_[k], spans_[l], v);
    }
    std::sort(breaks_.begin(), breaks_.end());
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
}

void Scanline::addDepthBreak(const Span& one, const Span& other, Real v) {
    const Affine& nearer = scene_.nearer(one.triangle, other.triangle);
    if (nearer.a == 0) return;
    const Real u = -(nearer.b * v + nearer.c) / nearer.a;
    if (u > std::max(one.u_lo, other.u_lo) && u < std::min(one.u_hi, other.u_hi)) breaks_.push_back(u);
}

Owner Scanline::ownerOfActive(Real u, Real v) {
    std::vector<std::size_t> order;
    for (const Span& span : active_) order.push_back(span.triangle);
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return i != j && scene_.wins(i, j, u, v); });
    std::vector<Owner> layers;
    for (std::size_t i : order) {
        const LocalTriangle& t = scene_.triangles()[i];
        if (layers.empty() || layers.back() != t.owner) layers.push_back(t.owner);
        if (!t.see_through) return nameOf(layers);
    }
    layers.push_back(kBackground);
    return nameOf(layers);
}

Owner Scanline::nameOf(const std::vector<Owner>& layers) {
    constexpr Owner kFirstName = 0x80000000u;
    if (layers.size() == 1) return layers.front();
    return stacks_.try_emplace(layers, kFirstName + Owner(stacks_.size())).first->second;
}

void Scanline::collectRuns(Real v) {
    runs_.clear();
    active_.clear();
    std::size_t next = 0;
    for (std::size_t k = 0; k + 1 < breaks_.size(); ++k) {
        const Real lo = breaks_[k], hi = breaks_[k + 1];
        std::erase_if(active_, [&](const Span& span) { return span.u_hi <= lo; });
        for (; next < spans_.size() && spans_[next].u_lo <= lo; ++next) active_.push_back(spans_[next]);
        const Owner owner = ownerOfActive((lo + hi) / 2, v);
        if (!runs_.empty() && runs_.back().owner == owner)
            runs_.back().u_hi = hi;
        else
            runs_.push_back({lo, hi, owner});
    }
}

}  // namespace edgewise::witness
