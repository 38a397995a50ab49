#include "tests/fuzz/sdf_from_bytes.h"

#include <bit>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "sdf/check_lipschitz.h"
#include "sdf/evaluate.h"
#include "sdf/load_glsl_map.h"
#include "sdf/load_sdf.h"
#include "sdf/prune.h"
#include "sdf/scene_error.h"
#include "sdf/scene_trace.h"

namespace edgewise::fuzz {
namespace {

std::string_view textOf(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string checkViews(const sdf::FieldScene& scene) {
    for (const sdf::SurfaceCamera& c : scene.cameras)
        if (!finite(c.eye_world) || !finite(c.target_world) || !finite(c.up_world) ||
            !std::isfinite(c.fovy_degrees) || !(c.ymag > 0.0))
            return "a camera that is not finite";
    for (const sdf::SurfaceLight& light : scene.lights)
        if (!finite(light.direction_world) || !finite(light.position_world) || !finite(light.color) ||
            !std::isfinite(light.intensity) || std::abs(glm::length(light.direction_world) - 1.0) > 1e-9)
            return "a light that is not finite, or whose direction is not of length 1";
    if (!(scene.far > 0.0) || !std::isfinite(scene.far)) return "far is no distance";
    if (scene.materials.empty()) return "no material";
    return "";
}

std::string checkShapes(const sdf::FieldScene& scene) {
    for (const sdf::AnalyticShape& shape : scene.analytic)
        if (shape.material >= scene.materials.size() || !finite(shape.center_world) ||
            !finite(shape.normal_world))
            return "an analytic shape out of range";
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(scene.bounds.low[i]) || !std::isfinite(scene.bounds.high[i]) ||
            scene.bounds.low[i] > scene.bounds.high[i])
            return "bounds that are none";
    return "";
}

/// A few rays from its cameras, on the tape and on what pruning leaves of it.
std::string checkTracing(const sdf::FieldScene& scene) {
    const sdf::Tape tape = sdf::lower(scene.tree);
    if (!(tape.lipschitz > 0.0) || !std::isfinite(tape.lipschitz)) return "no Lipschitz bound";
    sdf::checkLipschitz(scene, {1, 32});
    for (const glm::dvec3& p : {glm::dvec3(0.0), glm::dvec3(0.3, -1.7, 2.2), glm::dvec3(-40, 11, 5)}) {
        const double value = sdf::valueAt(tape, p);
        const sdf::Tape shorter = sdf::pruneTape(tape, p, 0.5);
        if (std::bit_cast<std::uint64_t>(sdf::valueAt(shorter, p)) != std::bit_cast<std::uint64_t>(value))
            return "pruning changes a value";
        sdf::gradientAt(tape, p);
        sdf::floatErrorAt(tape, glm::vec3(p));
    }
    sdf::TraceSettings settings;
    settings.most_steps = 64;
    const sdf::SceneTracer tracer(scene, tape, settings);
    for (const sdf::SurfaceCamera& camera : scene.cameras) {
        const glm::dvec3 way = camera.target_world - camera.eye_world;
        sdf::FieldRay ray{camera.eye_world, glm::normalize(way)};
        ray.t_max = scene.far, ray.pixel_slope = 1e-3;
        const sdf::SurfaceHit hit = tracer.nearest(ray, 1.0);
        if (hit.hit && hit.material >= scene.materials.size()) return "a material out of range";
        if (hit.evaluations > 10000) return "a ray without end";
    }
    return "";
}

std::string checked(const std::function<std::string()>& work) {
    try {
        return work();
    } catch (const sdf::SceneError& error) {
        const std::string words = error.element + error.rule;
        if (words.empty()) return "an error without words";
        return words.find('\n') == std::string::npos ? "" : "an error of several lines";
    } catch (const std::exception& error) {
        return std::string("throws ") + error.what();
    }
}

}  // namespace

std::string checkSdf(std::span<const std::uint8_t> bytes) {
    return checked([&]() -> std::string {
        sdf::FieldScene scene = sdf::loadSdf(textOf(bytes));
        scene.bounds = sdf::sceneBounds(scene);
        for (const auto& check : {checkViews, checkShapes})
            if (const std::string wrong = check(scene); !wrong.empty()) return wrong;
        return scene.tree.empty() ? "" : checkTracing(scene);
    });
}

std::string checkMap(std::span<const std::uint8_t> bytes) {
    return checked([&]() -> std::string {
        const sdf::FieldScene scene = sdf::loadGlslMap(textOf(bytes), "some.map.glsl");
        if (!scene.glsl || !(scene.glsl->lipschitz > 0.0)) return "no GLSL, or no bound";
        return checkViews(scene);
    });
}

}  // namespace edgewise::fuzz
