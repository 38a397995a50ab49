// The SDF scenes that ship: do they load, keep their bounds, and show something?
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "data/generate/recipes.h"
#include "pipeline/error.h"
#include "pipeline/load_scene.h"
#include "pipeline/methods/method.h"
#include "pipeline/resolve_camera.h"
#include "pipeline/scene_catalog.h"
#include "sdf/evaluate.h"
#include "sdf/field_scene.h"

namespace edgewise {
namespace {

Scene shipped(const std::string& name) {
    return loadScene(findScene(name));
}

/// Whether a ray meets the field or an analytic ball or plane before it ends.
bool meets(const sdf::FieldScene& field, const sdf::Tape& tape, const glm::dvec3& eye,
           const glm::dvec3& ray) {
    for (const sdf::AnalyticShape& shape : field.analytic) {
        if (shape.type == sdf::AnalyticShape::Type::kPlane) {
            const double t =
                (shape.offset - glm::dot(eye, shape.normal_world)) / glm::dot(ray, shape.normal_world);
            if (t > 0.0 && t < field.far) return true;
            continue;
        }
        const glm::dvec3 to = shape.center_world - eye;
        const double along = glm::dot(to, ray);
        if (along > 0.0 && glm::dot(to, to) - along * along < shape.radius * shape.radius) return true;
    }
    double t = 0.0;
    for (int step = 0; step < 2000 && t < field.far; ++step) {
        const double value = sdf::valueAt(tape, eye + t * ray);
        if (value < 1e-4 * t) return true;
        t += value / tape.lipschitz;
    }
    return false;
}

/// Of 32 x 18 rays of the camera.
double shareThatMeets(const Scene& scene, const Camera& camera) {
    const sdf::Tape tape = sdf::lower(scene.field->tree);
    const double top = std::tan(0.5 * camera.yfov);
    int hits = 0;
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 32; ++x) {
            const double px = (x + 0.5) / 16.0 - 1.0, py = 1.0 - (y + 0.5) / 9.0;
            const glm::dvec3 local = glm::normalize(glm::dvec3(px * top * 16.0 / 9.0, py * top, -1.0));
            const glm::dvec3 ray = glm::dmat3(camera.world_from_camera) * local;
            hits += meets(*scene.field, tape, glm::dvec3(camera.world_from_camera[3]), ray) ? 1 : 0;
        }
    return hits / (32.0 * 18.0);
}

TEST(SdfScenes, LoadAndKeepTheirBoundsAndShowSomething) {
    std::size_t cameras = 0;
    for (const scenes::Recipe& recipe : scenes::sdfRecipes()) {
        const Scene scene = shipped(recipe.name);
        ASSERT_TRUE(scene.field) << recipe.name;
        EXPECT_TRUE(scene.field->bound_holds) << recipe.name;
        EXPECT_TRUE(scene.field->warnings.empty()) << recipe.name << ": " << scene.field->warnings[0];
        EXPECT_TRUE(scene.field->background.has_value()) << recipe.name;
        EXPECT_GE(scene.field->materials.size(), 2u) << recipe.name;
        ASSERT_FALSE(scene.cameras.empty()) << recipe.name;
        EXPECT_LT(glm::length(scene.bounds_min), 1e4) << recipe.name;
        EXPECT_LT(scene.bounds_min.x, scene.bounds_max.x) << recipe.name;
        const sdf::Tape tape = sdf::lower(scene.field->tree);
        for (const Camera& camera : scene.cameras) {
            ++cameras;
            EXPECT_GT(sdf::valueAt(tape, glm::dvec3(camera.world_from_camera[3])), 0.01) << recipe.name;
            const double share = shareThatMeets(scene, camera);
            std::printf("%-16s %4zu nodes %4zu instructions, %5.1f %% of the rays meet something\n",
                        recipe.name.c_str(), scene.field->tree.nodes.size(), tape.size(), 100.0 * share);
            // Wires are thinner than a pixel: these rays may miss them all.
            EXPECT_GT(share, recipe.name == "wires" ? -1.0 : 0.2) << recipe.name;
        }
    }
    EXPECT_GE(cameras, 18u);
}

TEST(SdfScenes, WiresAreAsWideInPixelsAsTheySay) {
    const Scene scene = shipped("wires");
    const Camera& camera = scene.cameras.at(0);
    const double pixel = 2.0 * scene.field->cameras[0].eye_world.z * std::tan(0.5 * camera.yfov) / 720.0;
    double thinnest = 1e9, widest = 0.0;
    for (const sdf::Node& node : scene.field->tree.nodes) {
        if (node.kind != sdf::Kind::kCapsule) continue;
        EXPECT_EQ(node.numbers[2], 0.0);
        thinnest = std::min(thinnest, 2.0 * node.numbers[6] / pixel);
        widest = std::max(widest, 2.0 * node.numbers[6] / pixel);
    }
    // Widths are rounded to 1e-4 px, radii to 1e-9.
    EXPECT_NEAR(thinnest, 0.05, 1e-9 / pixel);
    EXPECT_NEAR(widest, 1.0, 0.5e-4 + 1e-9 / pixel);
}

TEST(SdfScenes, CamerasLightsAndFarPlanesAreTheirOwn) {
    const Scene scene = shipped("city");
    Film film;
    CameraOptions options;
    options.camera = "street";
    options.size = {64, 36};
    const ResolvedCamera camera = resolveCamera(scene, options, film);
    EXPECT_EQ(camera.camera.zfar, scene.field->far);
    const glm::dvec4 target(scene.field->cameras[1].target_world, 1.0);
    const glm::dvec4 seen = camera.camera_from_world * target;
    EXPECT_NEAR(seen.x, 0.0, 1e-12);
    EXPECT_NEAR(seen.y, 0.0, 1e-12);
    EXPECT_LT(seen.z, 0.0);
    ASSERT_EQ(scene.lights.size(), scene.field->lights.size());
    EXPECT_EQ(scene.lights[0].direction_world, scene.field->lights[0].direction_world);
}

}  // namespace
}  // namespace edgewise
