// What a prefilter does to a signal: its Fourier transform, its step response, and the numbers that sum them
// up. By quadrature of the kernel; no sample, picture or scene enters.
#pragma once

#include <functional>
#include <vector>

#include "analytic/prefilter.h"

namespace edgewise {

/// The highest frequency that samples a pixel apart tell from a lower one.
inline constexpr double kNyquist = 0.5;  ///< cycles/px

/// Angles in radians, of the normal of an edge or the wave vector of a grating; 0 is the x axis.
class FilterProperties {
  public:
    explicit FilterProperties(const Prefilter& filter);

    const Prefilter& filter() const { return filter_; }

    /// What (x, y) in px: int W cos 2 pi (x f_x + y f_y), at frequency f cycles/px. 1 at 0, real since W is
    /// even. Separable: k^(f_x) k^(f_y). Radial: 2 pi int_0^R W(r) J_0(2 pi f r) r dr.
    double transform(double f, double angle) const;

    /// The kernel's integral over the half plane n . x < t px: an edge t px from the sample. S(-t) = 1 -
    /// S(t).
    double stepResponse(double t, double angle) const;

    /// Half the support's extent along n, px: S is 0 and 1 beyond it.
    double reach(double angle) const;

    /// int |dW/dn| >= 2 pi f |W^(f)|, 1/px, jumps at the support's border counted.
    double variation(double angle) const;

    /// int max(-W, 0).
    double negativeArea() const;

    /// int x^2 W, px^2: of each axis. Not positive where the lobes outweigh.
    double secondMoment() const;

    /// max S - 1; 0 where no lobe is negative.
    double overshoot(double angle) const;

    /// Between the places nearest to the edge where S is 0.1 and 0.9, px.
    double edgeWidth(double angle) const;

    /// Where |W^| first falls to 1/2, cycles/px.
    double halfResponse(double angle) const;

  private:
    Prefilter filter_;
    std::vector<double> knot_;  ///< of W(r) on [0, R], or of k(x) on [-R, R]: smooth between
    double absolute_ = 1.0;     ///< int |W|, or int |k|
};

/// What is lost and what is false in a sampled ideal edge of contrast 1 along n, mean squares times px of the
/// edge's length (px), up to kEdgeBand:
///     blur     = 1/(2 pi^2) int_0^N (1 - W^(f))^2 / f^2 df
///     aliasing = 1/(2 pi^2) int_N^band W^(f)^2 / f^2 df
/// with N = kNyquist / max(|n_x|, |n_y|), where n leaves the square that samples can hold. Their sum is the
/// distance from the edge that holds all below N and nothing above (Parseval).
struct EdgeEnergy {
    double blur = 0.0, aliasing = 0.0;  ///< px
    double share = 0.0;                 ///< aliasing over that of no filter, 1/(2 pi^2 N)
};
inline constexpr double kEdgeBand = 16.0;  ///< cycles/px
EdgeEnergy edgeEnergy(const FilterProperties& properties, double angle);

/// The mean over all orientations of the edge.
EdgeEnergy meanEdgeEnergy(const FilterProperties& properties);

}  // namespace edgewise
