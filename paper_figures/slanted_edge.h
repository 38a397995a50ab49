// The product's own edge: a slanted half plane rendered by nsaa, read as ISO 12233 reads a photographed one.
#pragma once

#include <vector>

#include "analytic/prefilter.h"
#include "pipeline/progress.h"

namespace edgewise::figures {

/// Of an edge along the line p x + q y = const, p > q > 0 coprime, p + q odd: the samples of p rows lie at
/// all distances (k + 1/2) / sqrt(p^2 + q^2) from it, so that a picture of one sample a pixel is an edge
/// response sampled that finely.
struct SlantedEdge {
    double angle = 0.0;            ///< of the normal, radians
    double spacing_px = 0.0;       ///< between neighbouring distances
    std::vector<double> distance;  ///< px, ascending
    std::vector<double> value;     ///< the half plane's weight at each
};

/// Of at most 256 rows. Throws Interrupted when cancelled.
SlantedEdge measureEdge(const Prefilter& filter, int p, int q, Progress& progress);

/// The kernel's transform at f cycles/px along the edge's normal from differences of neighbouring values:
///     sum D cos(2 pi f t) / sinc(f spacing).
double measuredResponse(const SlantedEdge& edge, double f);

/// By how much it may differ from the transform: the aliases of samples `spacing` apart, f + m/spacing for m
/// != 0. |W^(g)| <= V/(2 pi |g|), V = FilterProperties::variation(), and the difference's sinc is f/|g| of
/// what was divided out, so with x = f spacing
///     |error| <= x spacing V/(2 pi) sum_(m != 0) 1/(x + m)^2 = x spacing V/(2 pi) (pi^2/sin^2(pi x) -
///     1/x^2),
/// plus 2^-52 a value for rounding.
double responseBound(const SlantedEdge& edge, double variation, double f);

}  // namespace edgewise::figures
