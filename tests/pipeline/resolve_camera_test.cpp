#include "pipeline/resolve_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "pipeline/error.h"

namespace edgewise {
namespace {

Scene box(const glm::dvec3& low, const glm::dvec3& high) {
    Scene scene;
    scene.bounds_min = low;
    scene.bounds_max = high;
    return scene;
}

Camera perspective(const std::string& name, double yfov, std::optional<double> aspect) {
    Camera camera;
    camera.name = name;
    camera.node = 0;
    camera.yfov = yfov;
    camera.znear = 0.5;
    camera.aspect = aspect;
    return camera;
}

Scene withCameras(std::vector<Camera> cameras) {
    Scene scene = box(glm::dvec3(-1), glm::dvec3(1));
    scene.source = "a.glb";
    scene.node_names = {"node"};
    scene.cameras = std::move(cameras);
    return scene;
}

std::string problemOf(const Scene& scene, const CameraOptions& options) {
    Film film;
    try {
        resolveCamera(scene, options, film);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

CameraOptions named(const std::string& camera) {
    CameraOptions options;
    options.camera = camera;
    return options;
}

TEST(ResolveCamera, NamesWinOverIndices) {
    Camera other = perspective("0", 2.0, {});
    other.node = 7;
    const Scene scene = withCameras({perspective("first", 1.0, {}), other});
    const auto yfov = [&](const std::string& name) {
        Film film;
        return resolveCamera(scene, named(name), film).camera.yfov;
    };
    EXPECT_EQ(yfov(""), 1.0);
    EXPECT_EQ(yfov("0"), 2.0);
    EXPECT_EQ(yfov("1"), 2.0);
    EXPECT_EQ(yfov("first"), 1.0);
    EXPECT_EQ(yfov("node"), 1.0);
    for (const char* wrong : {"2", "-1", "1.0", "eye"})
        EXPECT_EQ(problemOf(scene, named(wrong)),
                  std::string("--camera ") + wrong + ": the scene has 2 cameras, none of that name or index");
    EXPECT_NE(problemOf(Scene(), named("0")), "");
}

TEST(ResolveCamera, TheFilmFollowsTheAspectRatio) {
    const auto size = [](std::optional<double> aspect, std::optional<glm::ivec2> wanted) {
        CameraOptions options;
        options.size = wanted;
        Film film;
        const ResolvedCamera found =
            resolveCamera(withCameras({perspective("c", 1.0, aspect)}), options, film);
        EXPECT_EQ(*found.camera.aspect, static_cast<double>(film.width) / film.height);
        EXPECT_EQ(found.origin, "file");
        EXPECT_EQ(film.crop.width(), film.width);
        EXPECT_EQ(film.crop.height(), film.height);
        return glm::ivec2(film.width, film.height);
    };
    EXPECT_EQ(size({}, {}), glm::ivec2(1024, 1024));
    EXPECT_EQ(size(16.0 / 9.0, {}), glm::ivec2(1024, 576));
    EXPECT_EQ(size(1.5, {}), glm::ivec2(1024, 683));
    EXPECT_EQ(size(1e9, {}), glm::ivec2(1024, 1));
    EXPECT_EQ(size(1.5, glm::ivec2(10, 20)), glm::ivec2(10, 20));
    EXPECT_EQ(size(1e-9, glm::ivec2(10, 20)), glm::ivec2(10, 20))
        << "an absurd aspect ratio only matters when used";
}

TEST(ResolveCamera, OrthographicHoldsYmag) {
    Camera camera = perspective("flat", 0.0, {});
    camera.perspective = false;
    camera.xmag = 3.0;
    camera.ymag = 2.0;
    camera.znear = 0.0;
    camera.zfar = 1.0;
    Film film;
    EXPECT_EQ(resolveCamera(withCameras({camera}), {}, film).camera.ymag, 2.0);
    EXPECT_EQ(film.height, 683);
    CameraOptions options;
    options.size = glm::ivec2(100, 50);
    EXPECT_EQ(resolveCamera(withCameras({camera}), options, film).camera.xmag, 4.0);
    options.fovy_degrees = 30.0;
    EXPECT_EQ(problemOf(withCameras({camera}), options), "--fovy: the camera is orthographic");
}

TEST(ResolveCamera, ViewIsTheInverseOfTheCamera) {
    const double c = std::cos(0.3), s = std::sin(0.3);
    Camera camera = perspective("c", 1.0, {});
    camera.world_from_camera = glm::dmat4(c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 5, 6, 7, 1);
    Film film;
    const ResolvedCamera found = resolveCamera(withCameras({camera}), {}, film);
    const glm::dmat4 identity = found.camera_from_world * camera.world_from_camera;
    // Each entry: a product of four terms below 8, twice; c, s rounded once each.
    for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(identity[i / 4][i % 4], i % 5 == 0 ? 1.0 : 0.0, 16 * 8 * 0x1p-53);
}

TEST(ResolveCamera, FlagsMakeACamera) {
    CameraOptions options;
    options.eye = glm::dvec3(0, 0, 8);
    options.target = glm::dvec3(0, 0, -2);
    options.fovy_degrees = 60.0;
    Film film;
    const ResolvedCamera found = resolveCamera(withCameras({perspective("c", 1.0, 2.0)}), options, film);
    EXPECT_EQ(found.origin, "command line");
    EXPECT_EQ(found.camera.world_from_camera, glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 8, 1));
    EXPECT_EQ(found.camera.yfov, 60.0 * (glm::pi<double>() / 180.0));
    EXPECT_EQ(found.camera.znear, 10.0 / 1024.0);
    EXPECT_FALSE(found.camera.zfar);
    EXPECT_EQ(film.height, 1024);
    options.eye = glm::dvec3(0, 9, -2);  // straight down: up is -z
    EXPECT_EQ(resolveCamera(Scene(), options, film).camera.world_from_camera,
              glm::dmat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 9, -2, 1));
}

TEST(ResolveCamera, FlagsThatFitNothing) {
    const Scene scene = withCameras({perspective("c", 1.0, {})});
    CameraOptions options;
    options.target = glm::dvec3(1);
    EXPECT_EQ(problemOf(scene, options), "--target: needs --eye");
    options.eye = glm::dvec3(1);
    EXPECT_EQ(problemOf(scene, options), "--eye: has no finite distance to the target");
    options.eye = glm::dvec3(NAN);
    EXPECT_EQ(problemOf(scene, options), "--eye: is not finite");
    options.eye = glm::dvec3(2);
    options.camera = "c";
    EXPECT_EQ(problemOf(scene, options), "--eye: does not go with --camera");
    for (const double fovy : {0.0, -1.0, 180.0, 1e9, double(NAN)}) {
        CameraOptions bad;
        bad.fovy_degrees = fovy;
        EXPECT_TRUE(problemOf(scene, bad).starts_with("--fovy: ")) << fovy;
    }
    for (const glm::ivec2 size :
         {glm::ivec2(0, 5), glm::ivec2(5, 0), glm::ivec2(-1, 1), glm::ivec2(1 << 21, 1)}) {
        CameraOptions bad;
        bad.size = size;
        EXPECT_TRUE(problemOf(scene, bad).starts_with("--size: "));
    }
}

TEST(ResolveCamera, LensesWithoutAPictureAreRefused) {
    const auto refuse = [](const char* expected, auto&& spoil) {
        Camera camera = perspective("c", 1.0, {});
        camera.zfar = 2.0;
        camera.ymag = camera.xmag = 1.0;
        spoil(camera);
        EXPECT_EQ(
            problemOf(withCameras({camera}), {}).find(std::string("a.glb: camera of nodes[0]: ") + expected),
            0u)
            << expected << " | " << problemOf(withCameras({camera}), {});
    };
    refuse("yfov is 0", [](Camera& c) { c.yfov = 0.0; });
    refuse("yfov is -1", [](Camera& c) { c.yfov = -1.0; });
    refuse("yfov is 3.14", [](Camera& c) { c.yfov = glm::pi<double>(); });
    refuse("yfov is nan", [](Camera& c) { c.yfov = NAN; });
    refuse("znear is 0", [](Camera& c) { c.znear = 0.0; });
    refuse("zfar is 0.5", [](Camera& c) { c.zfar = 0.5; });
    refuse("aspect is 0", [](Camera& c) { c.aspect = 0.0; });
    refuse("ymag is 0", [](Camera& c) {
        c.perspective = false;
        c.ymag = 0.0;
    });
    refuse("ymag is -2", [](Camera& c) {
        c.perspective = false;
        c.ymag = -2.0;
    });
    refuse("znear is -1", [](Camera& c) {
        c.perspective = false;
        c.znear = -1.0;
    });
    refuse("its aspect ratio 1e-09", [](Camera& c) { c.aspect = 1e-9; });
}

/// The least distance, in units of the sphere's radius, between the bounding sphere and the frustum's planes.
double clearance(const Scene& scene, const ResolvedCamera& resolved) {
    const glm::dvec3 centre = 0.5 * (scene.bounds_min + scene.bounds_max);
    const double radius = glm::length(0.5 * (scene.bounds_max - scene.bounds_min));
    const glm::dvec3 p = glm::dvec3(resolved.camera_from_world * glm::dvec4(centre, 1.0));
    const double tan_y = std::tan(0.5 * resolved.camera.yfov), tan_x = tan_y * *resolved.camera.aspect;
    const auto toPlane = [&](double side, double tangent) {
        return (-p.z * tangent - std::abs(side)) / std::hypot(1.0, tangent);
    };
    const double sides = std::min(toPlane(p.x, tan_x), toPlane(p.y, tan_y));
    const double ends = std::min(-p.z - resolved.camera.znear, *resolved.camera.zfar + p.z);
    return (std::min(sides, ends) - radius) / radius;
}

TEST(ResolveCamera, FramingContainsTheSphereFromAbove) {
    constexpr unsigned kSeed = 20261123;
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int tiny = 0, huge = 0, narrow = 0, far = 0;
    double least = 1e9;
    for (int i = 0; i < 20000; ++i) {
        const double size = std::pow(10.0, 30.0 * unit(random)), offset = std::pow(10.0, 4.0 * unit(random));
        const glm::dvec3 half = size * glm::abs(glm::dvec3(unit(random), unit(random), unit(random)));
        const glm::dvec3 centre = size * offset * glm::dvec3(unit(random), unit(random), unit(random));
        const Scene scene = box(centre - half, centre + half);
        CameraOptions options;
        options.size = glm::ivec2(1 + static_cast<int>(2000 * std::abs(unit(random))),
                                  1 + static_cast<int>(2000 * std::abs(unit(random))));
        options.fovy_degrees = 90.0 + 89.0 * unit(random);
        Film film;
        const ResolvedCamera found = resolveCamera(scene, options, film);
        least = std::min(least, clearance(scene, found));
        tiny += size < 1e-20;
        huge += size > 1e20;
        narrow += *found.camera.aspect < 0.1;
        far += offset > 1e3;
        EXPECT_GT(found.camera.znear, 0.0);
        EXPECT_GT(glm::dvec3(found.camera.world_from_camera[2]).y, 0.0) << "the eye is above";
    }
    std::printf("seed %u: least clearance %.3g radii; %d tiny, %d huge, %d narrow, %d far\n", kSeed, least,
                tiny, huge, narrow, far);
    EXPECT_GT(least, 0.0);
    for (const int met : {tiny, huge, narrow, far}) EXPECT_GT(met, 500);
}

TEST(ResolveCamera, ScenesWithoutExtentAreFramedToo) {
    for (const glm::dvec3& point : {glm::dvec3(0.0), glm::dvec3(5.0), glm::dvec3(1e18, 0, 0)}) {
        Film film;
        const ResolvedCamera found = resolveCamera(box(point, point), {}, film);
        EXPECT_EQ(found.origin, "framing");
        EXPECT_EQ(film.height, 1024);
        const glm::dvec3 p = glm::dvec3(found.camera_from_world * glm::dvec4(point, 1.0));
        EXPECT_LT(p.z, -found.camera.znear);
        EXPECT_GT(p.z, -*found.camera.zfar);
    }
    EXPECT_TRUE(problemOf(box(glm::dvec3(-1.7e308), glm::dvec3(1.7e308)), {})
                    .ends_with("is too large to be framed; use --eye"));
}

}  // namespace
}  // namespace edgewise
