// What an edge should add to a weight, by numbers of one precision: the screen's of 106 bits, fast, or the
// judge's of 50 digits.
#pragma once

#include <memory>

#include "analytic/exact/kernel_weights.h"
#include "tests/studies/term_bounds/adversarial_edges.h"
#include "tests/studies/term_bounds/wide.h"

namespace edgewise::study {

template <class Number>
class Truth {
  public:
    virtual ~Truth() = default;
    /// The whole fan of a -> b, angles of what lies outside the disk included; the whole strip, with what
    /// lies right of the square.
    virtual Number total(const Edge& edge) const = 0;
    /// Radial: h int g dt over [t1, t2] px of the line, g as inside the disk.
    virtual Number piece(const Edge& edge, double t1, double t2) const = 0;
    /// Where a point stands along the border: its angle in turns; K(y).
    virtual Number position(glm::dvec2 p) const = 0;
};

/// By formulas of its own: radial kernels by antiderivatives along the line, the Gaussian by short Gauss
/// rules over (1 - e^-v)/v; separable ones integrated by parts,
///     int K(x) k(y) dy = [K(x) K(y)] - int k(x) K(y) dx,
/// with the factors that the oracle holds.
std::unique_ptr<Truth<Wide>> makeScreen(const Prefilter& filter);

/// The oracle's forms.
class Judge : public Truth<exact::Real> {
  public:
    explicit Judge(const Prefilter& filter) : weights_(filter) {}
    exact::Real total(const Edge& edge) const override;
    exact::Real piece(const Edge& edge, double t1, double t2) const override;
    exact::Real position(glm::dvec2 p) const override;
    /// The error that the last number comes with, by the oracle's own estimate.
    double reported() const { return reported_; }

  private:
    exact::Real kept(const exact::Weight& weight) const;
    exact::KernelWeights weights_;
    mutable double reported_ = 0.0;
};

}  // namespace edgewise::study
