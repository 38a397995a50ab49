// The groups that a window's cones meet, from the device, as FieldTracer gives them.
#pragma once

#include "pipeline/field_tracer.h"
#include "pipeline/vulkan/cone_rays.h"
#include "pipeline/vulkan/field_batches.h"
#include "pipeline/vulkan/field_window.h"

namespace edgewise::vulkan {

class ConeBands {
  public:
    /// Refers to its arguments. `most`: rays at once. `sign`: of the field at the rays' beginnings; 0: it is
    /// found there. `map`: the field is raw GLSL. `shade`: called for groups as cones pause at them, and in
    /// the end for the last ones, by ConeSettings::shade_at_once.
    using Shade = std::function<std::vector<glm::dvec4>(const std::vector<sdf::TravellingRay>& rays,
                                                        const std::vector<sdf::SurfaceHit>& hits)>;
    ConeBands(const sdf::RayGrid& grid, FieldBatches& batches, ConeRays& cones, std::size_t most, double sign,
              bool map, std::function<bool()> cancelled, Shade shade);

    FieldCones trace(const FieldWindow& window);

  private:
    /// Rows of samples, and the device's rays through them.
    struct Band {
        std::size_t first, last, stride;
        std::vector<sdf::TravellingRay> rays;
        struct Taken {
            sdf::ConeGroup group;
            glm::dvec4 color{0.0};  ///< if it is shaded at once
        };
        std::vector<std::vector<Taken>> taken;  ///< by ray; empty where none has had many
        std::size_t samples() const { return (last - first) * stride; }
        static constexpr std::size_t kNone = ~std::size_t{0};
        std::size_t sampleOf(std::size_t ray) const;  ///< kNone: beyond the window
        std::size_t rayOf(std::size_t sample) const {
            return rayIndex(sample % stride, sample / stride, stride);
        }
    };
    void traceBand(Band& band);
    void takeFull(Band& band);
    void shadeTaken(Band& band, const std::vector<std::size_t>& rays);
    void shadeLast(const Band& band, FieldCones& out, std::size_t first_sample);
    sdf::TravellingRay signedRay(const Band& band, std::size_t ray, const GpuConeState& state) const;
    void add(Band& band, FieldCones& out);
    void takeGroups(const Band& band, std::size_t ray, std::size_t first, FieldCones& out) const;
    void describeMap(FieldCones& out, std::size_t first_sample, std::size_t first_group);

    const sdf::RayGrid& grid_;
    FieldBatches& batches_;
    ConeRays& cones_;
    double reach_;
    std::size_t most_;
    double sign_;
    bool map_;
    std::function<bool()> cancelled_;
    Shade shade_;
};

}  // namespace edgewise::vulkan
