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

double window(double distance, double range) {
    const double ratio = distance / range, square = ratio * ratio;
    return std::max(0.0, 1.0 - square * square);
}

}  // namespace

Lighting::EyeLight Lighting::inEyeSpace(const Light& light, const glm::dmat4& camera_from_world) {
    EyeLight out;
    out.type = light.type;
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
    const auto directional = [](const EyeLight& l) { return l.type == Light::Type::kDirectional; };
    uniform_ = rig_ || (!perspective_ && std::all_of(lights_.begin(), lights_.end(), directional));
    if (!rig_) return;
    for (const RigLight& lamp : {kRigKey, kRigFill})
        lights_.push_back({Light::Type::kDirectional, glm::dvec3(0.0), -lamp.towards,
                           glm::dvec3(M_PI * lamp.intensity), 0.0, 0.0, 0.0});
}

glm::dvec3 Lighting::view(const glm::dvec3& p_eye) const {
    const double distance = std::sqrt(glm::dot(p_eye, p_eye));
    if (rig_ || !perspective_ || distance == 0.0) return {0.0, 0.0, 1.0};
    return -p_eye / distance;
}

Arrival Lighting::arrival(std::size_t i, const glm::dvec3& p_eye) const {
    const EyeLight& light = lights_[i];
    if (light.type == Light::Type::kDirectional) return {-light.along, light.strength};
    const glm::dvec3 way = light.position - p_eye;
    const double distance2 = glm::dot(way, way), distance = std::sqrt(distance2);
    if (distance2 == 0.0) return {};
    const glm::dvec3 towards = way / distance;
    double share = window(distance, light.range) / distance2;
    if (light.type == Light::Type::kSpot) {
        const double rim = (-glm::dot(towards, light.along) - light.cos_outer) * light.scale;
        const double cone = std::clamp(rim, 0.0, 1.0);
        share *= cone * cone;
    }
    return {towards, light.strength * share};
}

}  // namespace edgewise
