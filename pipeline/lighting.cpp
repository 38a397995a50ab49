#include "pipeline/lighting.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edgewise {
namespace {

/// In x87 arithmetic: the library's double functions have variants by instruction set.
double cosine(double radians) {
    return static_cast<double>(std::cos(static_cast<long double>(radians)));
}

/// The extension's bound on how sharp a cone's rim is.
constexpr double kLeastRim = 0.001;

int typeOf(const Light& light) {
    switch (light.type) {
        case Light::Type::kDirectional:
            return f64::kDirectionalLight;
        case Light::Type::kSpot:
            return f64::kSpotLight;
        default:
            return f64::kPointLight;
    }
}

}  // namespace

EyeLight Lighting::inEyeSpace(const Light& light, const glm::dmat4& camera_from_world) {
    EyeLight out;
    out.type = typeOf(light);
    out.position = glm::dvec3(camera_from_world * glm::dvec4(light.position_world, 1.0));
    out.along = glm::normalize(glm::dmat3(camera_from_world) * light.direction_world);
    out.strength = light.color * light.intensity;
    out.range = light.range.value_or(std::numeric_limits<double>::infinity());
    out.cos_outer = cosine(light.outer_cone_angle);
    out.scale = 1.0 / std::max(kLeastRim, cosine(light.inner_cone_angle) - out.cos_outer);
    return out;
}

Lighting::Lighting(const Scene& scene, const ResolvedCamera& camera)
    : rig_(scene.lights.empty()), perspective_(camera.camera.perspective) {
    for (const Light& light : scene.lights) lights_.push_back(inEyeSpace(light, camera.camera_from_world));
    const auto directional = [](const EyeLight& l) { return l.type == f64::kDirectionalLight; };
    directional_ = std::all_of(lights_.begin(), lights_.end(), directional);
    uniform_ = rig_ || (!perspective_ && directional_);
    if (rig_)
        for (const RigLight& lamp : {kRigKey, kRigFill})
            lights_.push_back({f64::kDirectionalLight, glm::dvec3(0.0), -lamp.towards,
                               glm::dvec3(M_PI * lamp.intensity), 0.0, 0.0, 0.0});
    if (!uniform_) return;
    for (std::size_t i = 0; i < lights_.size(); ++i)
        halfways_.push_back(f64::halfwayOf(view(glm::dvec3(0.0)), arrival(i, glm::dvec3(0.0)).towards));
}

}  // namespace edgewise
