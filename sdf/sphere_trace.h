// Sphere tracing of one ray, in double.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sdf/cell_tapes.h"
#include "sdf/tape.h"
#include "sdf/trace_settings.h"

namespace edgewise::sdf {

/// A ray with the pixel's radius (half its side) along it: radius(t) = pixel_radius + pixel_slope * t.
/// Perspective cameras have pixel_radius 0.
struct FieldRay {
    glm::dvec3 origin_world, direction_world;  ///< direction: unit
    double t_min = 0.0, t_max = 1000.0;
    double pixel_radius = 0.0, pixel_slope = 0.0;
};

enum class TraceEnd : unsigned char {
    kSurface,    ///< within the threshold
    kCandidate,  ///< out of steps; the candidate is within half a pixel
    kFar,        ///< beyond t_max
    kOutOfSteps  ///< out of steps, and no candidate within half a pixel: a miss
};

struct TraceHit {
    TraceEnd end = TraceEnd::kFar;
    double t = 0.0;
    double value = 0.0;             ///< the field's at t
    std::uint32_t evaluations = 0;  ///< of the field, all told
    std::uint32_t iterations = 0;   ///< when the ray ended
    std::uint32_t failed = 0;       ///< relaxed steps that were taken back
    bool hit() const { return end == TraceEnd::kSurface || end == TraceEnd::kCandidate; }
};

/// Traces the field times `sign` (-1: from within). Of a field that is no valid bound nothing is promised but
/// an end.
TraceHit traceRay(const Tape& tape, const FieldRay& ray, const TraceSettings& settings, double sign = 1.0);
/// The same hit, on the tapes of cells.
TraceHit traceRay(const CellTapes& cells, const FieldRay& ray, const TraceSettings& settings, double sign);

}  // namespace edgewise::sdf
