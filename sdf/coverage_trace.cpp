#include "sdf/coverage_trace.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sdf/analytic_shape.h"
#include "sdf/evaluate.h"
#include "sdf/shading_text.h"

namespace edgewise::sdf {
namespace {

/// The distance to all surfaces, positive on the ray's side of each.
class SceneDistance {
  public:
    SceneDistance(const FieldScene& scene, const Tape& tape, const FieldRay& ray)
        : scene_(scene), tape_(tape), ray_(ray) {
        const glm::dvec3 start = at(ray.t_min);
        if (!tape.instructions.empty() && valueAt(tape, start) < 0.0) sign_ = -1.0;
        for (const AnalyticShape& shape : scene.analytic)
            sides_.push_back(heightOver(shape, start) < 0.0 ? -1.0 : 1.0);
    }

    struct Sample {
        double t, distance;
        double value;         ///< of the field
        std::uint32_t shape;  ///< whose distance it is
    };
    Sample operator()(double t) { return sampleAt(at(t), t); }
    /// Whether light may be asked for from the hit: it faces the ray, and rays from it begin where it is
    /// free.
    bool beginsFree(const SurfaceHit& hit) {
        const glm::dvec3 side = hit.inside ? -hit.normal_world : hit.normal_world;
        if (!(dot(side, ray_.direction_world) < 0.0)) return false;
        const double offset = shading::dynamicOffset(TraceSettings{}.epsilon * hit.t, hit.value);
        return sampleAt(hit.p_world + side * offset, hit.t).distance > 0.0;
    }

    SurfaceHit hitAt(const Sample& sample, const SceneTracer& surfaces) const {
        if (sample.shape == SurfaceHit::kField)
            return surfaces.fieldHit(ray_, {TraceEnd::kSurface, sample.t, sample.value}, sign_);
        const AnalyticShape& shape = scene_.analytic[sample.shape];
        const bool sphere = shape.type == AnalyticShape::Type::kSphere, behind = sides_[sample.shape] < 0.0;
        SurfaceHit hit;
        hit.hit = true, hit.shape = sample.shape, hit.t = sample.t, hit.value = sample.distance;
        hit.material = shape.material, hit.inside = sphere && behind;
        hit.p_world = at(sample.t);
        hit.p_local = patternPoint(shape, hit.p_world, hit.t);
        hit.normal_world = sphere ? glm::normalize(hit.p_world - shape.center_world)
                                  : shape.normal_world * sides_[sample.shape];
        return hit;
    }
    double sign() const { return sign_; }

    std::uint32_t evaluations = 0;

  private:
    glm::dvec3 at(double t) const { return ray_.origin_world + ray_.direction_world * t; }

    Sample sampleAt(const glm::dvec3& p_world, double t) {
        Sample sample{t, std::numeric_limits<double>::infinity(), 0.0, SurfaceHit::kField};
        if (!tape_.instructions.empty()) {
            sample.value = valueAt(tape_, p_world);
            sample.distance = sign_ * sample.value / tape_.lipschitz;
            ++evaluations;
        }
        for (std::uint32_t i = 0; i < sides_.size(); ++i) {
            const double distance = sides_[i] * heightOver(scene_.analytic[i], p_world);
            if (distance < sample.distance) sample.distance = distance, sample.shape = i;
        }
        return sample;
    }

    const FieldScene& scene_;
    const Tape& tape_;
    const FieldRay& ray_;
    double sign_ = 1.0;
    std::vector<double> sides_;
};

/// One step more, and the sample where the secant of the last two says that the surface is.
SceneDistance::Sample surfaceBeyond(SceneDistance& distance, const SceneDistance::Sample& first,
                                    double step) {
    const SceneDistance::Sample second = distance(first.t + step);
    return distance(shading::secantRoot(first.t, first.distance, second.t, second.distance));
}

/// What is shaded: the estimate, unless it lies in the far half of a thin solid or beyond one; then a point
/// no farther from the first sample than what its distance says is free.
SurfaceHit shadedHit(SceneDistance& distance, const SceneTracer& surfaces, const SceneDistance::Sample& first,
                     const SceneDistance::Sample& estimate) {
    SurfaceHit hit = distance.hitAt(estimate, surfaces);
    if (distance.beginsFree(hit)) return hit;
    hit = distance.hitAt(distance(std::min(first.t + first.distance, estimate.t)), surfaces);
    // The point itself is free; what its field's slope says of others may not hold so near to something thin.
    if (!distance.beginsFree(hit)) hit.value = 0.0;
    return hit;
}

}  // namespace

CoverageHit coverageAlong(const FieldScene& scene, const Tape& tape, const SceneTracer& surfaces,
                          const FieldRay& ray, double reach, int most_steps) {
    SceneDistance distance(scene, tape, ray);
    CoverageHit result;
    result.sign = distance.sign();
    std::uint32_t steps = 0;
    for (double t = ray.t_min; t <= ray.t_max && steps < static_cast<std::uint32_t>(most_steps);) {
        const SceneDistance::Sample sample = distance(t);
        const double limit = reach * 2.0 * (ray.pixel_radius + ray.pixel_slope * t);
        ++steps;
        if (sample.distance < limit) {
            const SceneDistance::Sample estimate = surfaceBeyond(distance, sample, limit);
            result.surface = shadedHit(distance, surfaces, sample, estimate);
            result.coverage = shading::coverageOf(estimate.distance, limit);
            break;
        }
        t += sample.distance;
    }
    result.surface.evaluations = distance.evaluations;
    result.surface.iterations = steps;
    return result;
}

}  // namespace edgewise::sdf
