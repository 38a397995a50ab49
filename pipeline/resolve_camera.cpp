#include "pipeline/resolve_camera.h"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "pipeline/error.h"
#include "sdf/field_scene.h"

namespace edgewise {
namespace {

constexpr double kDefaultFovyDegrees = 45.0;
constexpr double kFramingMargin = 1.05;

double radians(double degrees) {
    return degrees * (glm::pi<double>() / 180.0);
}

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double length(const glm::dvec3& v) {
    return std::hypot(v.x, v.y, v.z);
}

/// Halves first: bounds near the largest double must not overflow.
glm::dvec3 centreOf(const Scene& scene) {
    return 0.5 * scene.bounds_min + 0.5 * scene.bounds_max;
}

struct Sphere {
    glm::dvec3 centre;
    double radius;
};

Sphere boundingSphere(const Scene& scene) {
    const glm::dvec3 centre = centreOf(scene);
    const double radius = length(0.5 * scene.bounds_max - 0.5 * scene.bounds_min);
    if (radius > length(centre) * 0x1p-20) return {centre, radius};
    return {centre, std::max(radius > 0.0 ? radius : 1.0, length(centre) * 0x1p-20)};
}

/// `toward_eye` is a unit vector.
glm::dmat4 lookAlong(const glm::dvec3& eye, const glm::dvec3& toward_eye) {
    const bool along_y = std::abs(toward_eye.x) + std::abs(toward_eye.z) < 0x1p-26;
    const glm::dvec3 up = along_y ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 x = glm::normalize(glm::cross(up, toward_eye));
    return glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(toward_eye, x), 0.0),
                      glm::dvec4(toward_eye, 0.0), glm::dvec4(eye, 1.0));
}

Camera cameraFromFlags(const Scene& scene, const CameraOptions& options) {
    const glm::dvec3 eye = *options.eye, target = options.target.value_or(centreOf(scene));
    if (!isFinite(eye)) throw InputError("--eye", "is not finite");
    if (!isFinite(target)) throw InputError("--target", "is not finite");
    const double distance = length(eye - target);
    if (!(distance > 0.0) || !std::isfinite(distance))
        throw InputError("--eye", "has no finite distance to the target");
    Camera camera;
    camera.name = "command line";
    camera.world_from_camera = lookAlong(eye, glm::normalize((eye - target) / distance));
    camera.yfov = radians(options.fovy_degrees.value_or(kDefaultFovyDegrees));
    camera.znear = distance * 0x1p-10;
    return camera;
}

Camera framingCamera(const Scene& scene, const CameraOptions& options, double aspect) {
    Camera camera;
    camera.name = "framing";
    camera.yfov = radians(options.fovy_degrees.value_or(kDefaultFovyDegrees));
    const Sphere sphere = boundingSphere(scene);
    const double tangent = std::tan(0.5 * camera.yfov) * std::min(1.0, aspect);
    // sin of the narrower half angle: radius / distance where the sphere touches the frustum's planes.
    const double distance = kFramingMargin * sphere.radius / (tangent / std::hypot(1.0, tangent));
    const glm::dvec3 toward_eye = glm::normalize(glm::dvec3(1.0, 0.8, 1.2));
    if (!std::isfinite(3.0 * distance) || !isFinite(sphere.centre + distance * toward_eye))
        throw InputError(scene.source, "is too large to be framed; use --eye");
    camera.world_from_camera = lookAlong(sphere.centre + distance * toward_eye, toward_eye);
    camera.znear = 0.5 * (distance - sphere.radius);
    camera.zfar = distance + 2.0 * sphere.radius;
    if (scene.field) {  // which may reach beyond its bounds
        camera.zfar = scene.field->far;
        camera.znear = std::min(distance, scene.field->far) * 0x1p-10;
    }
    return camera;
}

const std::string& nodeName(const Scene& scene, const Camera& camera) {
    static const std::string none;
    return camera.node < scene.node_names.size() ? scene.node_names[camera.node] : none;
}

Camera cameraByName(const Scene& scene, const std::string& wanted) {
    for (const Camera& camera : scene.cameras)
        if (wanted == nodeName(scene, camera) || wanted == camera.name) return camera;
    std::size_t index = 0;
    const char* const end = wanted.data() + wanted.size();
    const auto parsed = std::from_chars(wanted.data(), end, index);
    if (parsed.ec == std::errc() && parsed.ptr == end && index < scene.cameras.size())
        return scene.cameras[index];
    throw InputError("--camera " + wanted, fmt::format("the scene has {} cameras, none of that name or index",
                                                       scene.cameras.size()));
}

void checkFlags(const CameraOptions& options) {
    if (options.eye && !options.camera.empty()) throw InputError("--eye", "does not go with --camera");
    if (options.target && !options.eye) throw InputError("--target", "needs --eye");
    if (!options.fovy_degrees) return;
    const double fovy = *options.fovy_degrees;
    if (!(fovy > 0.0 && fovy < 180.0))
        throw InputError("--fovy", fmt::format("{} is not between 0 and 180", fovy));
}

void checkLens(const Camera& camera, const std::string& what) {
    const auto need = [&](bool holds, const char* name, double value, const char* rule) {
        if (!holds) throw InputError(what, fmt::format("{} is {}, {}", name, value, rule));
    };
    if (camera.perspective)
        need(camera.yfov > 0.0 && camera.yfov < glm::pi<double>(), "yfov", camera.yfov, "not in (0, pi)");
    if (!camera.perspective)
        need(camera.ymag > 0.0 && std::isfinite(camera.ymag), "ymag", camera.ymag, "not above 0");
    if (!camera.perspective)
        need(camera.znear >= 0.0 && std::isfinite(camera.znear), "znear", camera.znear, "negative");
    if (camera.perspective)
        need(camera.znear > 0.0 && std::isfinite(camera.znear), "znear", camera.znear, "not above 0");
    if (camera.zfar) need(*camera.zfar > camera.znear, "zfar", *camera.zfar, "not beyond znear");
    if (camera.aspect)
        need(*camera.aspect > 0.0 && std::isfinite(*camera.aspect), "aspect", *camera.aspect, "not above 0");
}

std::optional<double> ownAspect(const Camera& camera) {
    if (camera.perspective || camera.aspect) return camera.aspect;
    return camera.xmag != 0.0 ? std::optional(std::abs(camera.xmag / camera.ymag)) : std::nullopt;
}

/// `what` is blamed for an aspect ratio that makes no film.
void sizeFilm(const CameraOptions& options, std::optional<double> aspect, const std::string& what,
              Film& film) {
    const double height = std::max(1.0, std::round(kDefaultFilmWidth / aspect.value_or(1.0)));
    if (!options.size && !(height <= kMaxFilmSide))
        throw InputError(what, fmt::format("its aspect ratio {} makes a film {} pixels high, the limit is {}",
                                           *aspect, height, kMaxFilmSide));
    const glm::ivec2 size =
        options.size.value_or(glm::ivec2(kDefaultFilmWidth, static_cast<int>(std::min(height, 0x1p20))));
    if (size.x < 1 || size.y < 1 || size.x > kMaxFilmSide || size.y > kMaxFilmSide)
        throw InputError("--size", fmt::format("{}x{} is not between 1x1 and {}x{}", size.x, size.y,
                                               kMaxFilmSide, kMaxFilmSide));
    film.width = size.x;
    film.height = size.y;
    film.crop = {0, 0, size.x, size.y};
}

/// The inverse of a rotation and a translation.
glm::dmat4 rigidInverse(const glm::dmat4& m) {
    const glm::dmat3 rotation = glm::transpose(glm::dmat3(m));
    glm::dmat4 inverse(rotation);
    inverse[3] = glm::dvec4(-(rotation * glm::dvec3(m[3])), 1.0);
    return inverse;
}

ResolvedCamera withFilm(Camera camera, const Film& film, const char* origin) {
    camera.aspect = static_cast<double>(film.width) / film.height;
    if (!camera.perspective) camera.xmag = camera.ymag * *camera.aspect;
    return {camera, rigidInverse(camera.world_from_camera), origin};
}

ResolvedCamera resolveOwn(const Scene& scene, const CameraOptions& options, Film& film) {
    const Camera camera = cameraFromFlags(scene, options);
    sizeFilm(options, std::nullopt, "--eye", film);
    return withFilm(camera, film, "command line");
}

ResolvedCamera resolveFraming(const Scene& scene, const CameraOptions& options, Film& film) {
    sizeFilm(options, std::nullopt, "--size", film);
    return withFilm(framingCamera(scene, options, static_cast<double>(film.width) / film.height), film,
                    "framing");
}

ResolvedCamera resolveFromFile(const Scene& scene, const CameraOptions& options, Film& film) {
    Camera camera = options.camera.empty() ? scene.cameras.front() : cameraByName(scene, options.camera);
    const std::string what = camera.node == kNone
                                 ? fmt::format("{}: camera", scene.source)
                                 : fmt::format("{}: camera of nodes[{}]", scene.source, camera.node);
    if (options.fovy_degrees && !camera.perspective) throw InputError("--fovy", "the camera is orthographic");
    if (options.fovy_degrees) camera.yfov = radians(*options.fovy_degrees);
    checkLens(camera, what);
    sizeFilm(options, ownAspect(camera), what, film);
    return withFilm(camera, film, "file");
}

}  // namespace

ResolvedCamera resolveCamera(const Scene& scene, const CameraOptions& options, Film& film) {
    checkFlags(options);
    if (options.eye) return resolveOwn(scene, options, film);
    if (!scene.cameras.empty() || !options.camera.empty()) return resolveFromFile(scene, options, film);
    return resolveFraming(scene, options, film);
}

}  // namespace edgewise
