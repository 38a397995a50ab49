// What an SDF scene is lit by: its own lights, or the default rig.
#pragma once

#include "pipeline/methods/method.h"
#include "sdf/surface_light.h"

namespace edgewise {

/// The scene's lights and ambient light, or pipeline/lighting.h's rig where it has neither lights nor, for
/// paths
/// (`emission_counts`), anything that shines; the options' background. The rig throws no shadows.
sdf::ShadingSettings fieldShading(const MethodInput& in, const sdf::TraceSettings& trace,
                                  bool emission_counts);

/// The scene with materials as they are: no light, nothing mirrored or refracted.
std::shared_ptr<const sdf::FieldScene> unlit(const sdf::FieldScene& scene);

/// The scene's field. Throws InputError, for the method of that name, for scenes of triangles and of GLSL.
const sdf::FieldScene& requireTree(const std::string& method, const Scene& scene);

/// The scene's tree as a tape; empty without one. Throws InputError for a tree that cannot be lowered.
sdf::Tape loweredTree(const sdf::FieldScene& scene);

/// Adds to a result's counts.
void countRays(const sdf::RayCounts& rays, std::map<std::string, std::uint64_t>& counts);

}  // namespace edgewise
