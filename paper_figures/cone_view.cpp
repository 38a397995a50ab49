#include "paper_figures/cone_view.h"

#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "sdf/field_scene.h"

namespace edgewise::figures {

ConeView::ConeView(const std::string& name, int width, int height) : scene(loadScene(findScene(name))) {
    CameraOptions wanted;
    wanted.size = glm::ivec2(width, height);
    camera = resolveCamera(scene, wanted, film);
    options.device = DeviceChoice::kCpu;
    options.background = scene.field->background.value_or(glm::dvec3(0.0));
}

MethodResult ConeView::made(const std::string& method, Progress& progress) const {
    if (progress.cancelled()) throw Interrupted();
    Progress quiet;
    return runMethod(parseMethod(method), input(quiet));
}

}  // namespace edgewise::figures
