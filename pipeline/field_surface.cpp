#include "pipeline/field_surface.h"

#include <algorithm>
#include <cmath>

#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "sdf/evaluate.h"
#include "sdf/pattern_point.h"

namespace edgewise {
namespace {

/// How far from a corner to the centre shapes are asked for: mesh corners lie on creases, and beside them.
constexpr double kNearCorner = 0.1;
/// The same of points that are shaded.
constexpr double kInward = 0.02;

/// Whether light's ways are traced from a hit.
bool castsRays(const sdf::ShadingSettings& shading) {
    const auto bends = [](const sdf::SurfaceMaterial& m) { return m.reflectance > 0 || m.transmittance > 0; };
    return std::ranges::any_of(shading.lights, &sdf::SurfaceLight::shadows) ||
           std::ranges::any_of(shading.materials, bends);
}

}  // namespace

FieldSurface::FieldSurface(sdf::FieldScene field, sdf::ShadingSettings shading, const sdf::RayGrid& grid,
                           const FilmFootprint& footprint, double most_off_px)
    : field_(std::move(field)),
      tape_(loweredTree(field_)),
      grid_(grid),
      tracer_(field_, tape_, trustedSettings(field_, {})),
      shader_(std::move(shading), tracer_),
      footprint_(footprint),
      most_off_px_(most_off_px),
      casts_rays_(castsRays(shader_.settings())) {}

std::uint32_t FieldSurface::shapeAt(const glm::dvec3& p_world) const {
    glm::dvec3 local;
    const sdf::Instruction& shape = sdf::winnerAt(tracer_.cells().at(p_world).tape, p_world, local);
    return static_cast<std::uint32_t>(&shape - tape_.instructions.data());
}

std::uint32_t FieldSurface::materialOf(std::uint32_t shape) const {
    return std::min(tape_.instructions[shape].material,
                    static_cast<std::uint32_t>(field_.materials.size() - 1));
}

TriangleLook FieldSurface::lookAt(const glm::dvec3& p_world) const {
    const std::uint32_t shape = shapeAt(p_world);
    return {materialOf(shape), shape, glm::vec3(p_world)};
}

TriangleLook FieldSurface::lookOf(const glm::dvec3 (&corners_world)[3]) const {
    const glm::dvec3 centre = (corners_world[0] + corners_world[1] + corners_world[2]) / 3.0;
    TriangleLook look = lookAt(centre);
    for (const glm::dvec3& corner : corners_world)
        if (shapeAt(corner + kNearCorner * (centre - corner)) != look.shape) {
            look.shape = TriangleLook::kMixed;
            break;
        }
    return look;
}

glm::dvec3 FieldSurface::color(const SeenPoint& point) const {
    const TriangleLook& look = looks_[point.triangle];
    sdf::SurfaceHit hit;
    hit.hit = true, hit.inside = point.back_facing;
    hit.p_world = point.p_world;
    hit.normal_world = point.back_facing ? -point.normal_world : point.normal_world;
    std::uint32_t shape = look.shape;
    hit.material = look.material;
    if (shape == TriangleLook::kMixed) {
        const glm::dvec3 inward = kInward * (glm::dvec3(look.centre_world) - point.p_world);
        shape = shapeAt(point.p_world + inward);
        hit.material = materialOf(shape);
    }
    const sdf::TravellingRay way{rayTowards(grid_, point.p_world, hit.t), point.back_facing ? -1.0 : 1.0};
    if (field_.materials[hit.material].pattern != sdf::SurfaceMaterial::Pattern::kNone) {
        const glm::dvec3 p = sdf::patternPoint(hit.p_world, hit.normal_world, 0.0, hit.t);
        hit.p_local = sdf::localAt(tape_, tape_.instructions[shape], p);
    }
    // Points that something hides may lie within it: no further above the surface than the mesh may be.
    if (casts_rays_) {
        const double most_off = most_off_px_ * footprint_.pixelAt(hit.p_world);
        hit.value =
            std::clamp(sdf::valueAt(tracer_.cells().at(hit.p_world).tape, hit.p_world), -most_off, most_off);
    }
    sdf::RayCounts counts;
    return glm::dvec3(shader_.shade(way.ray, hit, counts, way.sign));
}

}  // namespace edgewise
