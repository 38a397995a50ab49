// A ray that ends near surfaces, and how much of its pixel they cover: "Sphere Tracing AA" (Lottes 2016).
#pragma once

#include "sdf/scene_trace.h"

namespace edgewise::sdf {

struct CoverageHit {
    double coverage = 1.0;  ///< of rays that meet nothing, full
    double sign = 1.0;      ///< -1: the ray began within the field's solid
    SurfaceHit surface;     ///< what is shaded: where the last two distances say that it is, or before it
};

/// Goes on until the distance is within `reach` of the pixel's diameter there, then one step of that length
/// through the surface. The two distances give the surface's place by the secant, and coverage falls with the
/// distance there. Where they do not fall, that is the first of the two. The surface that is shaded faces the
/// ray: where that place is within something thin or beyond it, it is one before it, which is known to be
/// free. Analytic shapes have distances too. `tape`: the scene's tree, empty without one, of which `surfaces`
/// was made.
CoverageHit coverageAlong(const FieldScene& scene, const Tape& tape, const SceneTracer& surfaces,
                          const FieldRay& ray, double reach, int most_steps);

}  // namespace edgewise::sdf
