// A ray that ends near surfaces, and how much of its pixel they cover: "Sphere Tracing AA" (Lottes 2016).
#pragma once

#include "sdf/scene_trace.h"

namespace edgewise::sdf {

struct CoverageHit {
    double coverage = 1.0;  ///< of rays that meet nothing, full
    double sign = 1.0;      ///< -1: the ray began within the field's solid
    SurfaceHit surface;     ///< where the ray is nearest to the surface, as far as it looked
};

/// Goes on until the distance is within `reach` of the pixel's diameter there, then one step of that length through the
/// surface. The two distances give the surface's place by the secant; coverage falls with the least of the three
/// distances. Analytic shapes have distances too.
/// `tape`: the scene's tree, empty without one, of which `surfaces` was made.
CoverageHit coverageAlong(const FieldScene& scene, const Tape& tape, const SceneTracer& surfaces,
                          const FieldRay& ray, double reach, int most_steps);

}  // namespace edgewise::sdf
