// The light that reaches a point: the file's punctual lights, or the default rig. No shadows.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "pipeline/film.h"
#include "pipeline/scene.h"
#include "pipeline/shading_text.h"

namespace edgewise {

/// The default rig for lit materials of files without lights, fixed to the camera (eye space: x right, y up,
/// z towards the viewer): an ambient term and two directional lights, each of pi * intensity lux, so that
/// white Lambert facing one of them shines with `intensity`.
struct RigLight {
    glm::dvec3 towards;  ///< unit, from the surface to the light
    double intensity;
};
inline constexpr double kRigAmbient = 0.15;
inline constexpr RigLight kRigKey{{2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0}, 0.8};
inline constexpr RigLight kRigFill{{-6.0 / 7.0, 2.0 / 7.0, 3.0 / 7.0}, 0.2};

using f64::Arrival, f64::EyeLight;

/// The lights of a scene in eye space, by KHR_lights_punctual:
///     directional: intensity lux, everywhere the same
///     point, spot: intensity candela / d^2, times the window max(0, 1 - (d / range)^4) if it has a range;
///     spot: times clamp((cos - cos outer) / max(0.001, cos inner - cos outer), 0, 1)^2, cos between its
///     direction and the ray.
/// A light gives nothing at its own position. Units: a colour value of 1 is 1 cd/m^2, so 1 lux on white
/// Lambert facing it gives 1/pi; --exposure scales PNGs. A file with lights gets no ambient term.
class Lighting {
  public:
    Lighting(const Scene& scene, const ResolvedCamera& camera);

    /// The file has no lights: the rig's ambient term counts, and the rig sees every surface from +z, the
    /// direction from which the camera looks, under perspective too. So flat triangles have one colour.
    bool isRig() const { return rig_; }

    /// Light and view direction are the same everywhere: the rig's, or directional lights on an orthographic
    /// camera.
    bool isUniform() const { return uniform_; }

    /// Unit, from the point to where it is seen from, eye space.
    glm::dvec3 view(const glm::dvec3& p_eye) const { return f64::viewFrom(p_eye, viewIsUniform()); }

    /// Every light is the same everywhere, whatever the view.
    bool isDirectional() const { return directional_; }

    /// view() is +z everywhere.
    bool viewIsUniform() const { return rig_ || !perspective_; }

    std::size_t count() const { return lights_.size(); }
    Arrival arrival(std::size_t i, const glm::dvec3& p_eye) const {
        return f64::arrivalAt(lights_[i], p_eye);
    }
    /// Between the view and a light that arrives from `towards`.
    f64::Halfway halfway(std::size_t i, const glm::dvec3& view, const glm::dvec3& towards) const {
        return halfways_.empty() ? f64::halfwayOf(view, towards) : halfways_[i];
    }
    const std::vector<EyeLight>& lights() const { return lights_; }

  private:
    static EyeLight inEyeSpace(const Light& light, const glm::dmat4& camera_from_world);

    std::vector<EyeLight> lights_;
    std::vector<f64::Halfway> halfways_;  ///< by light, where they are the same everywhere
    bool rig_, perspective_, directional_, uniform_;
};

}  // namespace edgewise
