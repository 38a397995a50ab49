// What methods ask of a device that traces an SDF scene: colours and hits at sample positions of a window.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/field_wavefront.h"
#include "pipeline/methods/method.h"
#include "sdf/cone_trace.h"
#include "sdf/field_scene.h"
#include "sdf/trace_settings.h"

namespace edgewise {

struct FieldSettings {
    sdf::TraceSettings trace;
    bool keep_parts = false;                 ///< FieldSamples::parts are wanted
    std::optional<sdf::ConeSettings> cones;  ///< for traceCones()
};

/// Samples of a window of pixels, row by row: a pixel has per_side^2 samples of the lattice, or one at
/// `positions_px` (by pixel).
struct FieldWindow {
    PixelBox pixels;
    int per_side = 1;
    std::vector<glm::dvec2> positions_px;
    std::size_t stride() const { return static_cast<std::size_t>(pixels.width()) * per_side; }
    std::size_t samples() const { return stride() * pixels.height() * per_side; }
};

/// A convex polygon of one colour within a pixel.
struct FilmPart {
    std::size_t sample = 0;  ///< the pixel's
    double share = 1.0;      ///< of the polygon that has the colour
    std::vector<glm::dvec2> polygon_px;
    glm::dvec4 color{0.0};
};

/// One entry a sample.
struct FieldSamples {
    std::vector<glm::dvec4> color;  ///< linear; the background's colour and alpha 0 where nothing is hit
    std::vector<double> depth;  ///< along the ray from the eye (orthographic: the image plane), world units;
                                ///< infinite: nothing is hit
    std::vector<glm::vec3> normal;       ///< unit, world; 0: nothing is hit
    std::vector<std::uint32_t> surface;  ///< the material; kNone: nothing is hit
    std::vector<float> residual;         ///< the field's value at the hit
    std::vector<std::uint32_t> evaluations, iterations;
    std::vector<std::uint8_t> mixed;  ///< 1: of more than one colour; empty where samples have one each
    std::vector<FilmPart> parts;      ///< of divided pixels, one pixel after the other; not an entry a sample

    /// Of so many samples that hit nothing; `mixed` is empty.
    static FieldSamples sized(std::size_t count);
    /// Depth, surface and normal, on the ray's side, of what a sample's ray meets.
    void take(std::size_t i, const sdf::FieldRay& ray, const sdf::SurfaceHit& hit);
};

/// What the cones around a window's samples meet, front to back. One entry a sample: `rays`, `evaluations`,
/// and `begin` with one more: a sample's groups are those from begin[i] up to begin[i + 1].
struct FieldCones {
    std::vector<sdf::TravellingRay> rays;
    std::vector<std::uint32_t> begin, evaluations;
    std::vector<sdf::ConeGroup> groups;
    std::vector<sdf::SurfaceHit> surfaces;  ///< where each group is shaded; see ConeSettings::hard_only
    std::vector<glm::dvec4> colors;         ///< of each group, by ConeSettings::shade_at_once; else none
    std::size_t samples() const { return rays.size(); }
};

class FieldTracer {
  public:
    virtual ~FieldTracer() = default;
    virtual FieldSamples trace(const FieldWindow& window) = 0;
    /// Wants FieldSettings::cones, and a scene without closed forms (fieldOfAll).
    virtual FieldCones traceCones(const FieldWindow& window) = 0;
    /// Linear colours of rays whose hits are known, as trace() gives them; sights as shadeWavefront() says.
    /// Neighbours should be near each other.
    virtual std::vector<glm::dvec4> shade(std::span<const sdf::TravellingRay> rays,
                                          std::span<const sdf::SurfaceHit> hits,
                                          std::vector<std::uint32_t>* sights = nullptr) = 0;
    /// Any other rays through the same scene.
    virtual RayBatches& batches() = 0;
    /// Adds its stage times, plan, counts, notes, set-up and device.
    virtual void report(MethodResult& result) const = 0;
};

/// Refer to the input, which outlives them. Throw InputError for a scene that the device cannot trace.
std::unique_ptr<FieldTracer> makeCpuFieldTracer(const MethodInput& input, const FieldSettings& settings);
std::unique_ptr<FieldTracer> makeVulkanFieldTracer(const MethodInput& input, const FieldSettings& settings);

}  // namespace edgewise
