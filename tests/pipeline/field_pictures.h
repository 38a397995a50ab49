// Small SDF scenes with a camera, for the tests of methods.
#pragma once

#include <gtest/gtest.h>

#include "pipeline/methods/method.h"
#include "sdf/field_scene.h"
#include "tests/pipeline/test_scene.h"

namespace edgewise::test {

struct FieldPicture {
    std::shared_ptr<sdf::FieldScene> field = std::make_shared<sdf::FieldScene>();
    Scene scene;
    ResolvedCamera camera;
    Film film;
    RenderOptions options;
    Prefilter filter = makePrefilter("box", {}, {});
    Progress progress;

    FieldPicture(int width, int height) : film(makeFilm(width, height)) {
        field->materials.resize(1);
        scene.source = "test";
        scene.field = field;
        options.device = DeviceChoice::kCpu;
    }
    MethodInput input() { return {scene, camera, film, filter, options, progress}; }
    MethodResult made(const std::string& method) { return runMethod(parseMethod(method), input()); }
};

/// One pixel is 1 unit: an orthographic camera on z = 10, looking down -z, the middle of the film at (0, 0).
inline FieldPicture flatPicture(int width, int height) {
    FieldPicture picture(width, height);
    picture.camera = makeOrthographic(0.5 * height);
    picture.camera.camera.world_from_camera[3] = glm::dvec4(0, 0, 10, 1);
    picture.camera.camera_from_world = glm::inverse(picture.camera.camera.world_from_camera);
    return picture;
}

inline sdf::SurfaceMaterial unlitWhite() {
    sdf::SurfaceMaterial material;
    material.shading = sdf::SurfaceMaterial::Shading::kUnlit;
    material.color = glm::dvec3(1.0);
    return material;
}

}  // namespace edgewise::test
