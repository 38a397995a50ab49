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

TraceHit traceRay(const CellTapes& cells, const FieldRay& ray, const TraceSettings& settings, double sign) {
    const double lipschitz = cells.whole().lipschitz;
    RayTrace trace(ray, settings);
    const TapeCell* cell = nullptr;
    while (trace.asks()) {
        const glm::dvec3 p = ray.origin_world + ray.direction_world * trace.askedAt();
        cell = &cells.at(p, cell);
        trace.take(valueAt(cell->tape, p) * (sign / lipschitz));
        cells.ran(*cell, 1);
    }
    return trace.hit(sign * lipschitz);
}

}  // namespace edgewise::sdf
