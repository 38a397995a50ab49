// The product's term of an edge, seen before it is rounded to fixed point: the same text, compiled once more.
#pragma once

#include "tests/studies/term_bounds/adversarial_edges.h"

namespace edgewise::study {

/// The edge in its canonical direction, towards +y, or -x if horizontal.
Edge canonical(const Edge& edge);

struct ObservedTerm {
    double term = 0.0;          ///< the part inside the support
    double t1 = 0.0, t2 = 0.0;  ///< radial: where the code cut the line, px from the foot point
    EdgeTerms fixed;            ///< lane 0: what the product goes on with
    bool touched = false, entered = false, left = false;
    bool clipped() const { return entered || left; }
};

/// `edge` is canonical. The sample stands at kSample px.
inline constexpr glm::dvec2 kSample{1000.5, 517.5};
EdgeInput inputOf(const Edge& edge);
ObservedTerm observe(const EdgeKernel& kernel, const Edge& edge);

}  // namespace edgewise::study
