// The plainest tracer that shading can be tested with: classic sphere tracing to a fixed closeness, analytic
// shapes by their equations.
#pragma once

#include <cmath>
#include <limits>

#include "sdf/evaluate.h"
#include "sdf/field_scene.h"
#include "sdf/surface_tracer.h"
#include "sdf/tree.h"

namespace edgewise::sdf::test {

class ClassicTracer : public SurfaceTracer {
  public:
    static constexpr double kCloseness = 1e-12;

    explicit ClassicTracer(const FieldScene& scene) : scene_(scene) {
        if (!scene.tree.empty()) tape_ = lower(scene.tree);
    }

    SurfaceHit nearest(const FieldRay& ray, double sign) const override {
        SurfaceHit hit = fieldHit(ray, sign);
        for (std::uint32_t i = 0; i < scene_.analytic.size(); ++i) {
            const AnalyticShape& shape = scene_.analytic[i];
            const double t =
                shape.type == AnalyticShape::Type::kSphere ? sphere(shape, ray) : plane(shape, ray);
            if (t < ray.t_min || t > ray.t_max || (hit.hit && t >= hit.t)) continue;
            hit = analyticHit(shape, ray, t, hit.evaluations);
            hit.shape = i;
        }
        return hit;
    }

    bool occluded(const FieldRay& ray, double sign, std::uint64_t& evaluations) const override {
        const SurfaceHit hit = nearest(ray, sign);
        evaluations += hit.evaluations;
        return hit.hit;
    }

  private:
    SurfaceHit fieldHit(const FieldRay& ray, double sign) const {
        SurfaceHit hit;
        if (scene_.tree.empty()) return hit;
        for (hit.t = ray.t_min; hit.t <= ray.t_max && hit.evaluations < 100000;) {
            hit.p_world = ray.origin_world + ray.direction_world * hit.t;
            hit.value = valueAt(tape_, hit.p_world);
            ++hit.evaluations;
            if (sign * hit.value < kCloseness) return surface(hit, sign);
            hit.t += sign * hit.value / tape_.lipschitz;
        }
        return hit;
    }
    SurfaceHit surface(SurfaceHit hit, double sign) const {
        hit.hit = true;
        hit.inside = sign < 0.0;
        hit.normal_world = normalize(gradientAt(tape_, hit.p_world).gradient);
        hit.material = winnerAt(tape_, hit.p_world, hit.p_local).material;
        if (hit.material == kNoMaterial) hit.material = scene_.materials.size() - 1;
        return hit;
    }
    static double sphere(const AnalyticShape& shape, const FieldRay& ray) {
        const glm::dvec3 from = ray.origin_world - shape.center_world;
        const double half = dot(from, ray.direction_world);
        const glm::dvec3 nearest = from - ray.direction_world * half;
        const double inner = shape.radius * shape.radius - dot(nearest, nearest);
        if (inner < 0.0) return std::numeric_limits<double>::infinity();
        const double root = std::sqrt(inner);
        return -half - root >= ray.t_min ? -half - root : -half + root;
    }
    static double plane(const AnalyticShape& shape, const FieldRay& ray) {
        const double slope = dot(shape.normal_world, ray.direction_world);
        if (slope == 0.0) return std::numeric_limits<double>::infinity();
        return (shape.offset - dot(shape.normal_world, ray.origin_world)) / slope;
    }
    static SurfaceHit analyticHit(const AnalyticShape& shape, const FieldRay& ray, double t,
                                  std::uint32_t evaluations) {
        SurfaceHit hit;
        hit.hit = true, hit.t = t, hit.evaluations = evaluations;
        hit.p_world = ray.origin_world + ray.direction_world * t;
        hit.material = shape.material;
        const bool is_sphere = shape.type == AnalyticShape::Type::kSphere;
        hit.p_local = is_sphere ? hit.p_world - shape.center_world : hit.p_world;
        hit.normal_world = is_sphere ? hit.p_local / shape.radius : shape.normal_world;
        const bool behind = dot(hit.normal_world, ray.direction_world) > 0.0;
        hit.inside = is_sphere && behind;
        if (!is_sphere && behind) hit.normal_world = -hit.normal_world;
        return hit;
    }

    const FieldScene& scene_;
    Tape tape_;
};

/// One node of a kind, with one material.
inline FieldScene sceneOf(Kind kind, std::vector<double> numbers, const SurfaceMaterial& material) {
    FieldScene scene;
    scene.materials = {material};
    scene.tree.add(kind, std::move(numbers), {}, 0);
    return scene;
}

inline FieldRay rayAlong(const glm::dvec3& origin, const glm::dvec3& direction) {
    return {origin, normalize(direction)};
}

}  // namespace edgewise::sdf::test
