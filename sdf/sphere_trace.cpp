#include "sdf/sphere_trace.h"

#include "sdf/evaluate.h"
#include "sdf/trace_loop.h"

namespace edgewise::sdf {

TraceHit traceRay(const Tape& tape, const FieldRay& ray, const TraceSettings& settings, double sign) {
    RayTrace trace(ray, settings);
    while (trace.asks())
        trace.take(valueAt(tape, ray.origin_world + ray.direction_world * trace.askedAt()) *
                   (sign / tape.lipschitz));
    return trace.hit(sign * tape.lipschitz);
}

}  // namespace edgewise::sdf
