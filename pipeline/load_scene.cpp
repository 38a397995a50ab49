#include "pipeline/load_scene.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "pipeline/error.h"
#include "pipeline/polygonize_map.h"
#include "sdf/check_lipschitz.h"
#include "sdf/load_glsl_map.h"
#include "sdf/load_sdf.h"
#include "sdf/scene_error.h"

namespace edgewise {
namespace {

namespace fs = std::filesystem;

constexpr double kNearOverDistance = 0x1p-10;

bool endsWith(const fs::path& path, std::string_view end) {
    const std::string name = path.filename().string();
    return name.size() > end.size() && name.ends_with(end);
}

/// At most a byte more than the limit, so that what is too long is told from what is not.
std::string readText(const fs::path& path, std::size_t most) {
    std::FILE* file = std::fopen(path.c_str(), "rb");
    if (!file) throw InputError(path.string(), fmt::format("cannot be read: {}", std::strerror(errno)));
    std::string text;
    char part[1 << 16];
    for (std::size_t got; text.size() <= most && (got = std::fread(part, 1, sizeof part, file)) > 0;)
        text.append(part, got);
    const bool failed = std::ferror(file) != 0;
    std::fclose(file);
    if (failed) throw InputError(path.string(), "cannot be read");
    return text;
}

glm::dmat4 lookAt(const sdf::SurfaceCamera& camera) {
    const glm::dvec3 back = glm::normalize(camera.eye_world - camera.target_world);
    const glm::dvec3 right = glm::normalize(glm::cross(camera.up_world, back));
    return glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(back, 0.0),
                      glm::dvec4(camera.eye_world, 1.0));
}

/// The near plane as for --eye.
Camera cameraOf(const sdf::SurfaceCamera& from, const sdf::FieldScene& field) {
    Camera camera;
    camera.name = from.name;
    camera.world_from_camera = lookAt(from);
    camera.perspective = from.perspective;
    camera.yfov = from.fovy_degrees * glm::pi<double>() / 180.0;
    camera.ymag = from.ymag;
    const double distance = glm::distance(from.eye_world, from.target_world);
    camera.znear = std::min(distance, field.far) * kNearOverDistance;
    camera.zfar = field.far;
    return camera;
}

Light lightOf(const sdf::SurfaceLight& from) {
    Light light;
    const bool point = from.type == sdf::SurfaceLight::Type::kPoint;
    light.type = point ? Light::Type::kPoint : Light::Type::kDirectional;
    light.color = from.color;
    light.intensity = from.intensity;
    light.position_world = from.position_world;
    light.direction_world = from.direction_world;
    return light;
}

/// Tells of broken bounds.
void check(sdf::FieldScene& field) {
    for (const sdf::LipschitzViolation& violation : sdf::checkLipschitz(field)) {
        field.warnings.push_back(wordsOf(violation));
        field.bound_holds = false;
    }
}

/// What a camera frames that the file has not.
void findBounds(sdf::FieldScene& map) {
    if (const auto bounds = boundsOfMap(map))
        map.bounds = *bounds;
    else
        map.warnings.push_back("no camera, and no bounds of the map were found: the origin is framed");
}

sdf::FieldScene readField(const fs::path& path, const LoadOptions& options) {
    if (!options.scene.empty()) throw InputError("--scene", "an SDF file holds one scene");
    if (!options.animation.empty()) throw InputError("--animation", "SDF scenes have none");
    const bool is_map = endsWith(path, ".map.glsl");
    if (options.time && !is_map) throw InputError("--time", "this SDF scene does not move");
    const std::string text = readText(path, is_map ? sdf::kMostMapBytes : sdf::kMostSceneBytes);
    if (options.progress) options.progress(0.1);
    sdf::FieldScene field = is_map ? sdf::loadGlslMap(text, path.string()) : sdf::loadSdf(text);
    if (field.glsl) field.glsl->time = options.time.value_or(0.0);
    if (options.progress) options.progress(0.5);
    return field;
}

Scene sceneOf(sdf::FieldScene field, const fs::path& path) {
    Scene scene;
    scene.source = field.source = path.string();
    for (const sdf::SurfaceCamera& camera : field.cameras) scene.cameras.push_back(cameraOf(camera, field));
    for (const sdf::SurfaceLight& light : field.lights) scene.lights.push_back(lightOf(light));
    for (int i = 0; i < 3; ++i)
        scene.bounds_min[i] = field.bounds.low[i], scene.bounds_max[i] = field.bounds.high[i];
    scene.field = std::make_shared<const sdf::FieldScene>(std::move(field));
    return scene;
}

}  // namespace

bool isFieldFile(const fs::path& path) {
    return endsWith(path, ".sdf.json") || endsWith(path, ".map.glsl");
}

Scene loadScene(const fs::path& path, const LoadOptions& options) {
    if (!isFieldFile(path)) return loadGltf(path, options);
    try {
        sdf::FieldScene field = readField(path, options);
        check(field);
        if (field.glsl && field.cameras.empty()) findBounds(field);
        if (options.progress) options.progress(1.0);
        return sceneOf(std::move(field), path);
    } catch (const sdf::SceneError& error) {
        throw InputError(path.string(), error.what());
    }
}

}  // namespace edgewise
