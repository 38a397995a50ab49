// The weight of an exact face in the support of a sample, to 30 digits or better, by ways of its own: radial
// kernels by whole fans from the sample (angles and all), separable ones by strips with series in both axes,
// both by Gauss-Legendre rules; the box in rationals.
#pragma once

#include <memory>

#include "analytic/exact/visible_faces.h"
#include "analytic/prefilter.h"

namespace edgewise::exact {

struct Weight {
    Real value = 0;
    Real error = 0;  ///< estimated: one rule against two halves, and what roundings may add
};

/// The share of the square of half width `radius` around the sample that the face covers: exact.
Rational boxWeight(const Face& face, const Point& sample, const Rational& radius);

class KernelWeights {
  public:
    explicit KernelWeights(const Prefilter& filter);
    ~KernelWeights();

    Weight of(const Face& face, const Point& sample) const;

    /// What the directed edge a -> b adds to the weight of a face on the side of growing angle: the whole fan
    /// (the angles of what lies outside the disk included), the whole strip (with what lies right of the
    /// square).
    Weight ofEdge(const Point& a, const Point& b, const Point& sample) const;
    /// Radial kernels: the integral of h g dt over [t1, t2] px of the edge's line, from the sample's foot
    /// point.
    Weight ofPiece(const Point& a, const Point& b, const Point& sample, const Real& t1, const Real& t2) const;
    /// Where a point stands along the border: radial, its angle in turns, (-1/2, 1/2]; separable, K(y).
    Weight position(const Point& p, const Point& sample) const;

    const Rational& radius() const { return radius_; }

    struct Form;  ///< how one directed edge counts

  private:
    std::unique_ptr<const Form> form_;
    Rational radius_;
};

}  // namespace edgewise::exact
