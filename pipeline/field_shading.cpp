#include "pipeline/field_shading.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/error.h"
#include "pipeline/field_rays.h"
#include "sdf/scene_error.h"

namespace edgewise {
namespace {

bool shines(const sdf::FieldScene& scene) {
    return std::ranges::any_of(scene.materials, [](const auto& m) { return m.emission != glm::dvec3(0.0); });
}

}  // namespace

sdf::ShadingSettings fieldShading(const MethodInput& in, const sdf::TraceSettings& trace,
                                  bool emission_counts) {
    const sdf::FieldScene& scene = *in.scene.field;
    sdf::ShadingSettings settings = shadingOf(scene, trace);
    settings.background = in.options.background;
    if (!scene.lights.empty() || (emission_counts && shines(scene))) return settings;
    addDefaultRig(in.camera, settings);
    return settings;
}

std::shared_ptr<const sdf::FieldScene> unlit(const sdf::FieldScene& scene) {
    auto copy = std::make_shared<sdf::FieldScene>(scene);
    for (sdf::SurfaceMaterial& material : copy->materials) {
        material.shading = sdf::SurfaceMaterial::Shading::kUnlit;
        material.reflectance = material.transmittance = 0.0;
    }
    return copy;
}

const sdf::FieldScene& requireTree(const std::string& method, const Scene& scene) {
    const std::string who = fmt::format("method '{}'", method);
    if (!scene.field)
        throw InputError(who, fmt::format("needs an SDF scene, and '{}' holds triangles", scene.source));
    if (scene.field->glsl)
        throw InputError(who, fmt::format("runs on the CPU, and '{}' is GLSL, which Vulkan alone evaluates",
                                          scene.source));
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
