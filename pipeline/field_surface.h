// What a mesh of an SDF scene looks like: the field's own materials, patterns and light at the mesh's points.
#pragma once

#include <vector>

#include "pipeline/film_footprint.h"
#include "pipeline/point_shader.h"
#include "sdf/field_scene.h"
#include "sdf/ray_grid.h"
#include "sdf/scene_trace.h"
#include "sdf/shader.h"

namespace edgewise {

/// What a triangle of the mesh is made of.
struct TriangleLook {
    std::uint32_t material = sdf::kNoMaterial;
    /// The tape's shape in whose frame patterns are; kMixed: of several shapes, asked at each point.
    std::uint32_t shape = 0;
    glm::vec3 centre_world{0.0f};

    static constexpr std::uint32_t kMixed = 0xffffffffu;
};

/// Shades as tracing does: points of the mesh are hits with the mesh's normals. Shadows, mirrors and glass
/// are traced through the field.
class FieldSurface : public PointShader {
  public:
    /// `field`: without closed forms beside its tree. `most_off_px`: the mesh is no further from the surface,
    /// in the film's pixels.
    FieldSurface(sdf::FieldScene field, sdf::ShadingSettings shading, const sdf::RayGrid& grid,
                 const FilmFootprint& footprint, double most_off_px);

    /// A further triangle, in the order of the contract's index.
    void add(const TriangleLook& look) { looks_.push_back(look); }
    /// Of a triangle, by the shapes that win at its centre and near its corners.
    TriangleLook lookOf(const glm::dvec3 (&corners_world)[3]) const;
    /// Of one that is all of a shape: the one that wins at a point.
    TriangleLook lookAt(const glm::dvec3& p_world) const;

    glm::dvec3 color(const SeenPoint& point) const override;

    const sdf::Tape& tape() const { return tape_; }
    const sdf::SceneTracer& tracer() const { return tracer_; }

  private:
    std::uint32_t shapeAt(const glm::dvec3& p_world) const;
    std::uint32_t materialOf(std::uint32_t shape) const;

    const sdf::FieldScene field_;
    const sdf::Tape tape_;
    const sdf::RayGrid grid_;
    const sdf::SceneTracer tracer_;
    const sdf::Shader shader_;
    const FilmFootprint footprint_;
    const double most_off_px_;
    const bool casts_rays_;
    std::vector<TriangleLook> looks_;
};

}  // namespace edgewise
