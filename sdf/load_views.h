// Materials, cameras, lights and analytic shapes of a document.
#pragma once

#include "sdf/field_scene.h"
#include "sdf/parse_json.h"

namespace edgewise::sdf {

/// "materials": an object by names, or a list of objects with names. The default one comes last.
std::vector<SurfaceMaterial> readMaterials(const Json& document);

/// The index of the material of that name. Throws SceneError.
std::uint32_t findMaterial(const std::vector<SurfaceMaterial>& materials, const std::string& name,
                           const std::string& path);

/// "cameras", "lights", "analytic", "convex" and the scene's own numbers. Wants the materials.
void readViews(const Json& document, FieldScene& scene);

/// Throws SceneError where eye and target coincide, or the up vector points along the view.
void requireView(const SurfaceCamera& camera, const std::string& path);

}  // namespace edgewise::sdf
