#include <cmath>

#include "pipeline/field_tracer.h"

namespace edgewise {

FieldSamples FieldSamples::sized(std::size_t count) {
    FieldSamples out;
    out.color.resize(count), out.depth.resize(count, HUGE_VAL), out.normal.resize(count, glm::vec3(0.0f));
    out.surface.resize(count, kNone), out.residual.resize(count);
    out.evaluations.resize(count), out.iterations.resize(count);
    return out;
}

void FieldSamples::take(std::size_t i, const sdf::FieldRay& ray, const sdf::SurfaceHit& hit) {
    if (!hit.hit) return;
    depth[i] = hit.t, surface[i] = hit.material;
    const bool away = glm::dot(hit.normal_world, ray.direction_world) > 0.0;
    normal[i] = glm::vec3(away ? -hit.normal_world : hit.normal_world);
}

}  // namespace edgewise
