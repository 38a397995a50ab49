// Batches of rays through a whole scene: its field on the device, closed forms and the convex bound by the
// host.
#pragma once

#include <functional>
#include <optional>

#include "pipeline/field_wavefront.h"
#include "pipeline/vulkan/field_rays.h"
#include "sdf/scene_trace.h"

namespace edgewise::vulkan {

/// A sphere that all points lie in whose value is at most `level` over the field's bound; infinite radius: no
/// sphere is known.
struct FieldSphere {
    glm::dvec4 sphere{0.0, 0.0, 0.0, INFINITY};
    double level = 0.0;
    /// Where the ray leaves the sphere, if what comes within `reach` pixel radii there is no higher than the
    /// level; else t_max.
    double lastT(const GpuRay& ray, double t_max, double reach) const;
};

class FieldBatches : public RayBatches {
  public:
    /// Refers to its arguments. `tape`: empty where the scene has no tree. `rays`: nullptr where it has no
    /// field. `most`: rays at once.
    FieldBatches(const sdf::FieldScene& scene, const sdf::Tape& tape, const FieldShaders& shaders,
                 const sdf::TraceSettings& settings, FieldRays* rays, const FieldSphere& around,
                 std::size_t most, std::function<bool()> cancelled);

    /// Where a ray's sign is 0, the field's where it begins counts. Neighbours of 64 should be near each
    /// other.
    std::vector<sdf::SurfaceHit> nearest(std::span<const sdf::TravellingRay> rays) override;
    std::vector<double> depths(std::span<const sdf::TravellingRay> rays) override;
    std::vector<sdf::SurfaceHit> describe(std::span<const sdf::TravellingRay> rays,
                                          std::span<const double> depths) override;
    std::vector<char> occluded(std::span<const sdf::TravellingRay> rays) override;

    /// The ray through the field alone, of which all within `reach` pixel radii counts.
    GpuRay askWithin(const sdf::TravellingRay& ray, double reach) const;
    /// A sphere for lists.
    const glm::dvec4& bounds() const { return lists_; }
    /// Points on rays as hits of the field, not described yet.
    static sdf::SurfaceHit surfaceAt(const sdf::TravellingRay& ray, double t);
    /// Gives hits of the field, neighbours, their normals and materials: of a tree; of a map on all rays at
    /// once, by the device.
    void describeTree(std::span<sdf::SurfaceHit*> hits) const;
    void describeMap(std::span<const sdf::TravellingRay> rays, std::span<sdf::SurfaceHit> hits);

  private:
    /// What is asked of the device, and what the host knows already.
    struct Question {
        sdf::SurfaceHit closed;
        double t_end = 0.0;  ///< backwards: where the ray begins
        bool backwards = false;
    };
    GpuRay ask(const sdf::TravellingRay& ray, Question& question) const;
    FieldAnswers traceField(const std::vector<GpuRay>& rays, bool with_hits);
    void nearestPart(std::span<const sdf::TravellingRay> rays, std::span<sdf::SurfaceHit> hits,
                     bool described);
    void occludedPart(std::span<const sdf::TravellingRay> rays, std::span<char> hidden);
    sdf::SurfaceHit answer(const sdf::TravellingRay& ray, const Question& question, const GpuRayState& state,
                           const GpuHit& hit) const;
    void takeMap(sdf::SurfaceHit& hit, const GpuHit& of, double sign) const;

    const sdf::FieldScene& scene_;
    const sdf::Tape& tape_;
    const FieldShaders& shaders_;
    const sdf::TraceSettings& settings_;
    FieldRays* rays_;
    FieldSphere around_;
    glm::dvec4 lists_;
    std::size_t most_;
    std::function<bool()> cancelled_;
    sdf::SceneTracer closed_;
};

}  // namespace edgewise::vulkan
