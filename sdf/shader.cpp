#include "sdf/shader.h"

#include <utility>
#include <vector>

#include "sdf/shading_text.h"

namespace edgewise::sdf {
namespace {

/// Whether the ray is worth tracing.
bool add(const Shader::Branch& branch, std::vector<Shader::Branch>& next) {
    const glm::dvec3& share = branch.share;
    if (std::max(share.x, std::max(share.y, share.z)) < Shader::kLeastShare) return false;
    next.push_back(branch);
    return true;
}

}  // namespace

Shader::Shader(ShadingSettings settings, const SurfaceTracer& tracer)
    : settings_(std::move(settings)), tracer_(tracer) {}

glm::dvec4 Shader::radiance(const FieldRay& ray, RayCounts& counts, double sign) const {
    ++counts.primary;
    const SurfaceHit hit = tracer_.nearest(ray, sign);
    counts.evaluations += hit.evaluations;
    return shade(ray, hit, counts, sign);
}

glm::dvec4 Shader::shade(const FieldRay& ray, const SurfaceHit& hit, RayCounts& counts, double sign) const {
    if (!hit.hit) return {settings_.background, 0.0};
    // The last one first: no more than one of every hit waits.
    std::vector<Branch> branches;
    glm::dvec3 sum = follow(first(ray, sign), hit, tracer_, branches, counts);
    while (!branches.empty()) {
        const Branch branch = branches.back();
        branches.pop_back();
        const SurfaceHit next = tracer_.nearest(branch.way.ray, branch.way.sign);
        counts.evaluations += next.evaluations;
        sum +=
            next.hit ? follow(branch, next, tracer_, branches, counts) : branch.share * settings_.background;
    }
    return {sum, 1.0};
}

glm::dvec3 Shader::follow(const Branch& branch, const SurfaceHit& hit, const SurfaceTracer& shadows,
                          std::vector<Branch>& next, RayCounts& counts) const {
    const SurfacePoint point = surfacePoint(settings_, branch.way, hit);
    const glm::dvec3 shares = sharesOf(point);
    Branch on = branch;
    if (branch.way.medium != kNoMaterial)
        on.share *= shading::absorbed(settings_.materials[branch.way.medium].absorption, hit.t);
    if (shares.y > 0.0) reflect(on, hit, point, shares.y, next, counts);
    if (shares.z > 0.0) refract(on, hit, point, shares.z, next, counts);
    glm::dvec3 sent = point.material->emission;
    if (shares.x > 0.0) sent += shares.x * litBy(settings_, shadows, branch.way, hit, point, counts);
    return on.share * sent;
}

/// All of it within glass is the refraction's way on.
void Shader::reflect(Branch branch, const SurfaceHit& hit, const SurfacePoint& point, double share,
                     std::vector<Branch>& next, RayCounts& counts) const {
    const glm::dvec3 direction = branch.way.ray.direction_world;
    const bool total = point.material->transmittance > 0.0 &&
                       shading::refracted(direction, point.normal, point.eta) == glm::dvec3(0.0);
    int& left = total ? branch.refractions : branch.reflections;
    if (left-- == 0) return;
    branch.share *= share;
    branch.way = rayFrom(settings_, branch.way, hit, point, shading::mirrored(direction, point.normal));
    if (add(branch, next)) ++(total ? counts.refraction : counts.reflection);
}

void Shader::refract(Branch branch, const SurfaceHit& hit, const SurfacePoint& point, double share,
                     std::vector<Branch>& next, RayCounts& counts) const {
    if (branch.refractions-- == 0) return;
    const glm::dvec3 direction = shading::refracted(branch.way.ray.direction_world, point.normal, point.eta);
    branch.share *= share;
    branch.way = rayThrough(settings_, branch.way, hit, point, direction);
    if (add(branch, next)) ++counts.refraction;
}

}  // namespace edgewise::sdf
