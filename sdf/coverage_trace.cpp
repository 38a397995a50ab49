#include "sdf/coverage_trace.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sdf/evaluate.h"
#include "sdf/shading_text.h"

namespace edgewise::sdf {
namespace {

double shapeValue(const AnalyticShape& shape, const glm::dvec3& p) {
    return shape.type == AnalyticShape::Type::kSphere ? length(p - shape.center_world) - shape.radius
                                                      : dot(p, shape.normal_world) - shape.offset;
}

/// The distance to all surfaces, positive on the ray's side of each.
class SceneDistance {
  public:
    SceneDistance(const FieldScene& scene, const Tape& tape, const FieldRay& ray)
        : scene_(scene), tape_(tape), ray_(ray) {
        const glm::dvec3 start = at(ray.t_min);
        if (!tape.instructions.empty() && valueAt(tape, start) < 0.0) sign_ = -1.0;
        for (const AnalyticShape& shape : scene.analytic)
            sides_.push_back(shapeValue(shape, start) < 0.0 ? -1.0 : 1.0);
    }

    struct Sample {
        double t, distance;
        double value;         ///< of the field
        std::uint32_t shape;  ///< whose distance it is
    };
    Sample operator()(double t) {
        Sample sample{t, std::numeric_limits<double>::infinity(), 0.0, SurfaceHit::kField};
        if (!tape_.instructions.empty()) {
            sample.value = valueAt(tape_, at(t));
            sample.distance = sign_ * sample.value / tape_.lipschitz;
            ++evaluations;
        }
        for (std::uint32_t i = 0; i < sides_.size(); ++i) {
            const double distance = sides_[i] * shapeValue(scene_.analytic[i], at(t));
            if (distance < sample.distance) sample.distance = distance, sample.shape = i;
        }
        return sample;
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
        hit.p_local = sphere ? hit.p_world - shape.center_world : hit.p_world;
        hit.normal_world = sphere ? glm::normalize(hit.p_local) : shape.normal_world * sides_[sample.shape];
        return hit;
    }
    double sign() const { return sign_; }

    std::uint32_t evaluations = 0;

  private:
    glm::dvec3 at(double t) const { return ray_.origin_world + ray_.direction_world * t; }

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
            result.surface = distance.hitAt(estimate, surfaces);
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
