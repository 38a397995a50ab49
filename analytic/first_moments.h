// Where in a support an owner is seen: first moments of the visible regions, one closed form a (segment,
// sample).
#pragma once

#include <glm/vec2.hpp>

#include "analytic/edge_integral.h"
#include "analytic/visible_segment.h"

namespace edgewise {

/// The kernel that centroids are taken with: the filter itself if it is radial and nowhere negative, else the
/// constant on its support, the square ("box") or the disk ("disk") of the same radius. A separable or
/// negative-lobe kernel would pull a centroid out of what is seen.
Prefilter centroidMeasure(const Prefilter& filter);

/// First moments of a measure W (a disk, cone, Gaussian, even polynomial or box):
///     int over P of (q - s) W(q - s) dq = sum over P's directed edges of n int Psi dt, [E17]
/// n = (d.y, -d.x) outward, Psi the radial primitive that is 0 on the support's border: no border shares.
class FirstMoments {
  public:
    explicit FirstMoments(const Prefilter& measure);

    /// The moment that the segment adds to its left owner, in units of R; its right owner gets the negative.
    /// Absolute error a few 2^-53 for each unit of distance from the sample to the segment's line. 0 outside
    /// the support. Adding whole pixels to everything changes no bit.
    glm::dvec2 moment(const VisibleSegment& segment, const CarrierLine& line, glm::dvec2 sample_px) const;

  private:
    struct Piece {
        double h, t1, t2;  ///< in units of the radius
    };
    double psiIntegral(const Piece& piece) const;
    double gaussianIntegral(const Piece& piece) const;
    double polyIntegral(const Piece& piece) const;
    glm::dvec2 radialMoment(Piece piece, glm::dvec2 direction) const;

    TermForm form_;
    double radius_;  ///< R, px
    double inner_;   ///< radius of what counts, in units of R; below 1 for Gaussians that are 0 beyond
    double inner_v_ = 0.0, per_sigma_ = 1.0;  ///< Gaussian: v at the inner radius; R / sigma
    GaussRule rule_;
    std::vector<double> suffix_;  ///< polynomial: Psi = -(1 - q)/(2 pi) sum_j suffix_[j] q^j
};

}  // namespace edgewise
