#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "pipeline/cli/command.h"
#include "pipeline/cli/interrupt.h"
#include "pipeline/cli/picture_options.h"
#include "pipeline/field_plan.h"
#include "pipeline/json_text.h"
#include "pipeline/plan.h"
#include "pipeline/progress_bar.h"
#include "pipeline/project.h"
#include "pipeline/shade.h"
#include "sdf/field_scene.h"

namespace edgewise::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
    PictureArguments picture;
    bool json = false;
};

Json asJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// Rows from the top: eye = view * world, for column vectors.
Json asJson(const glm::dmat4& m) {
    Json rows = Json::array();
    for (int r = 0; r < 4; ++r) rows.push_back({m[0][r], m[1][r], m[2][r], m[3][r]});
    return rows;
}

Json countsJson(const Scene& scene) {
    std::size_t vertices = 0;
    for (const Geometry& geometry : scene.geometry) vertices += geometry.position_world.size();
    return {{"triangles", scene.triangle_count},   {"vertices", vertices},
            {"primitives", scene.geometry.size()}, {"nodes", scene.node_names.size()},
            {"meshes", scene.mesh_names.size()},   {"materials", scene.materials.size()},
            {"textures", scene.textures.size()},   {"images", scene.images.size()},
            {"cameras", scene.cameras.size()}};
}

/// Radians; a far plane at infinity is null.
Json lensJson(const Camera& camera) {
    Json json{{"type", camera.perspective ? "perspective" : "orthographic"}};
    if (camera.perspective)
        json["yfov"] = camera.yfov;
    else
        json["ymag"] = camera.ymag;
    json["near"] = camera.znear;
    json["far"] = camera.zfar ? Json(*camera.zfar) : Json(nullptr);
    return json;
}

Json camerasJson(const Scene& scene) {
    Json list = Json::array();
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Camera& camera = scene.cameras[i];
        Json json{{"index", i},
                  {"name", camera.name},
                  {"node", camera.node == kNone ? Json(nullptr) : Json(camera.node)}};
        json.update(lensJson(camera));
        json["aspect"] = camera.aspect ? Json(*camera.aspect) : Json(nullptr);
        list.push_back(json);
    }
    return list;
}

Json resolvedCameraJson(const Picture& picture) {
    Json json{{"origin", picture.camera.origin}, {"name", picture.camera.camera.name}};
    json.update(lensJson(picture.camera.camera));
    json["view"] = asJson(picture.camera.camera_from_world);
    json["size"] = {picture.film.width, picture.film.height};
    return json;
}

/// The default rig, in eye space.
Json rigJson() {
    Json list{{{"type", "ambient"}, {"intensity", kRigAmbient}}};
    for (const RigLight& light : {kRigKey, kRigFill})
        list.push_back({{"type", "directional"},
                        {"frame", "camera"},
                        {"towards", asJson(light.towards)},
                        {"intensity", light.intensity}});
    return list;
}

/// One of the file's, in world space.
Json lightJson(const Light& light) {
    const bool directional = light.type == Light::Type::kDirectional, spot = light.type == Light::Type::kSpot;
    Json json{{"name", light.name},
              {"node", light.node == kNone ? Json(nullptr) : Json(light.node)},
              {"type", directional ? "directional" : (spot ? "spot" : "point")},
              {"frame", "world"},
              {"color", asJson(light.color)},
              {"intensity", light.intensity}};
    if (!directional) json["position"] = asJson(light.position_world);
    if (directional || spot) json["direction"] = asJson(light.direction_world);
    if (light.range) json["range"] = *light.range;
    if (spot) json["cone"] = {light.inner_cone_angle, light.outer_cone_angle};
    return json;
}

Json lightsJson(const Scene& scene) {
    if (scene.lights.empty()) return rigJson();
    Json list = Json::array();
    for (const Light& light : scene.lights) list.push_back(lightJson(light));
    return list;
}

Json ignoredJson(const Scene& scene) {
    Json list = Json::array();
    for (const Ignored& ignored : scene.ignored)
        list.push_back({{"what", ignored.what}, {"count", ignored.count}});
    return list;
}

Json entriesJson(const std::vector<PlanEntry>& plan) {
    Json list = Json::array();
    for (const PlanEntry& entry : plan)
        list.push_back({{"stage", entry.stage}, {"runs", entry.runs}, {"why", entry.why}});
    return list;
}

/// What nsaa would do by default.
Json planJson(const Picture& picture) {
    ScreenPieces pieces;
    const ScreenScene screen = project(picture.scene, picture.camera, picture.film, pieces);
    const Shading shading(picture.scene, picture.camera, picture.film, screen, pieces);
    return entriesJson(makePlan(picture.scene, screen, pieces, shading, RenderOptions{}).entries);
}

/// Kinds with how often each is there, in the order of kindInfos().
Json kindsJson(const sdf::Tree& tree) {
    Json kinds = Json::object();
    for (const sdf::KindInfo& kind : sdf::kindInfos()) {
        const auto count = std::count_if(tree.nodes.begin(), tree.nodes.end(),
                                         [&](const sdf::Node& node) { return node.kind == kind.kind; });
        if (count > 0) kinds[std::string(kind.name)] = count;
    }
    return kinds;
}

/// The last material is the default one, which the file has not.
Json fieldCountsJson(const sdf::FieldScene& field, const sdf::Tape& tape) {
    return {{"nodes", field.tree.nodes.size()},        {"instructions", tape.size()},
            {"materials", field.materials.size() - 1}, {"analytic", field.analytic.size()},
            {"lights", field.lights.size()},           {"cameras", field.cameras.size()}};
}

Json fieldJson(const Picture& picture) {
    const Scene& scene = picture.scene;
    const sdf::FieldScene& field = *scene.field;
    const sdf::Tape tape = field.tree.empty() ? sdf::Tape() : sdf::lower(field.tree);
    return {{"scene", scene.source},
            {"counts", fieldCountsJson(field, tape)},
            {"kinds", kindsJson(field.tree)},
            {"field",
             {{"form", field.glsl ? "GLSL" : "tree"},
              {"lipschitz", field.glsl ? field.glsl->lipschitz : tape.lipschitz},
              {"bound_holds", field.bound_holds},
              {"path_traced", field.path_traced},
              {"far", field.far}}},
            {"bounds", {{"min", asJson(scene.bounds_min)}, {"max", asJson(scene.bounds_max)}}},
            {"cameras", camerasJson(scene)},
            {"camera", resolvedCameraJson(picture)},
            {"lights", lightsJson(scene)},
            {"ignored", ignoredJson(scene)},
            {"plan", entriesJson(fieldPlan(field))},
            {"warnings", field.warnings}};
}

Json infoJson(const Picture& picture) {
    const Scene& scene = picture.scene;
    if (scene.field) return fieldJson(picture);
    return {{"scene", scene.source},
            {"counts", countsJson(scene)},
            {"bounds", {{"min", asJson(scene.bounds_min)}, {"max", asJson(scene.bounds_max)}}},
            {"cameras", camerasJson(scene)},
            {"camera", resolvedCameraJson(picture)},
            {"lights", lightsJson(scene)},
            {"ignored", ignoredJson(scene)},
            {"plan", planJson(picture)}};
}

/// "name value" a line; lists of objects one object a line.
void printInWords(const Json& info) {
    for (const auto& [name, value] : info.items()) {
        if (value.is_array() && value.empty()) {
            fmt::print("{:<8} none\n", name);
        } else if (value.is_array()) {
            for (const Json& entry : value) fmt::print("{:<8} {}\n", name, jsonText(entry));
        } else if (value.is_object()) {
            for (const auto& [key, entry] : value.items())
                fmt::print("{:<8} {:<10} {}\n", name, key, jsonText(entry));
        } else {
            fmt::print("{:<8} {}\n", name, value.get<std::string>());
        }
    }
}

void info(const InfoArguments& arguments) {
    ProgressBar quiet(false, interruptFlag());
    const Json json = infoJson(loadPicture(arguments.picture, quiet));
    if (arguments.json)
        fmt::print("{}\n", jsonText(json, 2));
    else
        printInWords(json);
}

}  // namespace

void addInfo(CLI::App& program) {
    CLI::App* command = program.add_subcommand(
        "info", "what is in a scene, its resolved camera and lights, what is ignored, the plan");
    auto arguments = std::make_shared<InfoArguments>();
    addPictureOptions(*command, arguments->picture);
    command->add_flag("--json", arguments->json, "as JSON; the view matrix by rows, angles in radians");
    acceptQuiet(*command);
    command->callback([arguments] { info(*arguments); });
}

}  // namespace edgewise::cli
