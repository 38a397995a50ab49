// Sampling methods on SDF scenes: which rays, how their colours become pixels, what else is known of them.
#pragma once

#include "pipeline/field_tracer.h"
#include "pipeline/methods/method.h"

namespace edgewise {

/// One sample at the pixel's centre. `edge`: 1 where a neighbour within the film differs.
MethodResult tracePixels(const MethodInput& in, const FieldSettings& settings, const FieldTracerMaker& make);

/// K x K samples a pixel, filtered; each is shaded where it lands, and hit within a K-th of the threshold.
/// `edge`: 1 where the support's differ.
MethodResult traceFiltered(const MethodInput& in, const FieldSettings& settings, int per_side,
                           const FieldTracerMaker& make);

/// Pixels whole or in parts (FieldSettings::keep_parts), each weighted by the integral of the filter over it.
/// `edge`: 1 where the support's differ.
MethodResult traceParts(const MethodInput& in, const FieldSettings& settings, const FieldTracerMaker& make);

}  // namespace edgewise
