#include "pipeline/methods/mesh_report.h"

namespace edgewise {

nlohmann::ordered_json meshJson(const std::optional<MeshReport>& mesh) {
    if (!mesh) return nullptr;
    return {{"mesher", mesh->mesher},
            {"triangles", mesh->triangles},
            {"pixel", mesh->pixel_world},
            {"max_error_px", mesh->asked_px},
            {"mesh_to_surface", mesh->mesh_to_surface},
            {"surface_to_mesh", mesh->surface_to_mesh},
            {"error_px", mesh->error_px},
            {"cell", mesh->cell_world},
            {"no_shadows", mesh->no_shadows},
            {"seconds", mesh->seconds}};
}

std::optional<MeshReport> meshFromJson(const nlohmann::json& json) {
    if (json.is_null()) return std::nullopt;
    MeshReport mesh;
    mesh.mesher = json.at("mesher");
    mesh.triangles = json.at("triangles");
    mesh.pixel_world = json.at("pixel"), mesh.asked_px = json.at("max_error_px");
    mesh.error_px = json.at("error_px");
    mesh.mesh_to_surface = json.at("mesh_to_surface"), mesh.surface_to_mesh = json.at("surface_to_mesh");
    mesh.cell_world = json.at("cell"), mesh.seconds = json.at("seconds");
    mesh.no_shadows = json.value("no_shadows", false);
    return mesh;
}

}  // namespace edgewise
