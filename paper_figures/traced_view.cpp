#include "paper_figures/traced_view.h"

#include <cmath>

#include "pipeline/error.h"
#include "pipeline/field_shading.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"

namespace edgewise::figures {

TracedView::TracedView(const std::string& name, int width, int height) : scene(loadScene(findScene(name))) {
    scene.field = unlit(*scene.field);
    CameraOptions wanted;
    wanted.size = glm::ivec2(width, height);
    camera = resolveCamera(scene, wanted, film);
    options.device = DeviceChoice::kCpu;
    rays = rayGrid(camera, film, scene.field->far);
}

double TracedView::pixelRadius(double depth) const {
    const sdf::FieldRay ray = rays.ray({0.5 * film.width, 0.5 * film.height});
    return ray.pixel_radius + ray.pixel_slope * depth;
}

Traced trace(const TracedView& view, const sdf::TraceSettings& settings, Progress& progress) {
    if (progress.cancelled()) throw Interrupted();
    FieldSettings field;
    field.trace = settings;
    Progress quiet;
    const MethodInput input{view.scene, view.camera, view.film, view.filter, view.options, quiet};
    const auto tracer = makeCpuFieldTracer(input, field);
    Traced traced;
    traced.samples = tracer->trace({view.film.crop, 1, {}});
    tracer->report(traced.report);
    for (const StageTime& stage : traced.report.stages)
        if (stage.name == "trace") traced.seconds += stage.seconds;
    return traced;
}

sdf::TraceSettings settingsOf(sdf::Relaxation relaxation, bool prepass, double omega) {
    sdf::TraceSettings settings;
    settings.relaxation = relaxation;
    settings.omega = omega;
    settings.prepass = prepass;
    return settings;
}

double keinertOmega(const std::string& scene) {
    return scene == "path-room" ? 1.4 : 1.2;
}

bool sameHit(const TracedView& view, double depth, double other_depth) {
    constexpr double kRadii = 64.0;
    const bool hit = std::isfinite(depth);
    if (hit != std::isfinite(other_depth)) return false;
    return !hit || std::abs(depth - other_depth) <= kRadii * view.pixelRadius(depth);
}

}  // namespace edgewise::figures
