#include "pipeline/field_shading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/error.h"
#include "pipeline/lighting.h"
#include "sdf/scene_error.h"

namespace edgewise {
namespace {

sdf::SurfaceLight rigLight(const RigLight& lamp, const glm::dmat3& world_from_camera) {
    sdf::SurfaceLight light;
    light.direction_world = glm::normalize(world_from_camera * -lamp.towards);
    light.intensity = M_PI * lamp.intensity;
    light.shadows = false;
    return light;
}

bool shines(const sdf::FieldScene& scene) {
    return std::ranges::any_of(scene.materials, [](const auto& m) { return m.emission != glm::dvec3(0.0); });
}

}  // namespace

sdf::ShadingSettings fieldShading(const MethodInput& in, const sdf::TraceSettings& trace, bool emission_counts) {
    const sdf::FieldScene& scene = *in.scene.field;
    sdf::ShadingSettings settings = shadingOf(scene, trace);
    settings.background = in.options.background;
    if (!scene.lights.empty() || (emission_counts && shines(scene))) return settings;
    const glm::dmat3 world_from_camera(in.camera.camera.world_from_camera);
    for (const RigLight& lamp : {kRigKey, kRigFill}) settings.lights.push_back(rigLight(lamp, world_from_camera));
    settings.ambient = glm::dvec3(kRigAmbient);
    return settings;
}

const sdf::FieldScene& requireTree(const std::string& method, const Scene& scene) {
    const std::string who = fmt::format("method '{}'", method);
    if (!scene.field) throw InputError(who, fmt::format("needs an SDF scene, and '{}' holds triangles", scene.source));
    if (scene.field->glsl)
        throw InputError(who, fmt::format("runs on the CPU, and '{}' is GLSL, which Vulkan alone evaluates", scene.source));
    return *scene.field;
}

sdf::Tape loweredTree(const sdf::FieldScene& scene) {
    if (scene.tree.empty()) return {};
    try {
        return sdf::lower(scene.tree);
    } catch (const sdf::SceneError& error) {
        throw InputError(scene.source + ": " + error.element, error.rule);
    }
}

void countRays(const sdf::RayCounts& rays, std::map<std::string, std::uint64_t>& counts) {
    counts["rays_primary"] += rays.primary;
    counts["rays_shadow"] += rays.shadow;
    counts["rays_reflection"] += rays.reflection;
    counts["rays_refraction"] += rays.refraction;
    counts["rays_scattered"] += rays.scattered;
    counts["evaluations"] += rays.evaluations;
}

}  // namespace edgewise
