#include "pipeline/judge/camera_cases.h"

#include <glm/gtc/matrix_transform.hpp>

#include "pipeline/judge/camera_scene.h"
#include "pipeline/judge/case_tools.h"

namespace edgewise::judge {
namespace {

using Triangles = std::vector<WorldTriangle>;

/// The origin of the world lies at a point of eye space: float32 is finest there.
CameraView viewAround(const dvec3& origin_eye, double znear) {
    CameraView view;
    view.world_from_camera = glm::translate(glm::dmat4(1.0), -origin_eye);
    view.znear = znear;
    return view;
}

/// Turned at random, so that eye space is rounded.
CameraView turnedView(Random& random, const dvec3& position, double znear) {
    CameraView view;
    const dvec3 axis(random.around(1.0), random.within(0.1, 1.0));
    view.world_from_camera =
        glm::rotate(glm::translate(glm::dmat4(1.0), position), random.angle(), glm::normalize(axis));
    view.znear = znear;
    return view;
}

void addTriangle(Triangles& out, const CameraView& view, const dvec3& a, const dvec3& b, const dvec3& c) {
    out.push_back({view.toWorld(a), view.toWorld(b), view.toWorld(c)});
}

/// Two triangles: neighbours at b - d.
void addQuad(Triangles& out, const CameraView& view, const dvec3& a, const dvec3& b, const dvec3& c,
             const dvec3& d) {
    addTriangle(out, view, a, b, d);
    addTriangle(out, view, b, c, d);
}

/// Half the support is covered far behind everything else.
void addBackdrop(Triangles& out, const CameraView& view, Random& random, double radius, double w) {
    const double turn = random.angle(), size = 4.0 * radius;
    const dvec2 along = size * direction(turn), beside = size * direction(turn + 0.5 * kPi);
    addQuad(out, view, view.seenAt(-along, w), view.seenAt(beside, w), view.seenAt(along, w),
            view.seenAt(0.1 * beside, w));
}

/// Quads through the near plane at the angle of the difficulty, cut within the support.
StiffScene nearPlaneAngle(double angle, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, angle);
    const dvec3 origin = CameraView().seenAt(random.around(0.3 * filter.radius), 1.0);
    const CameraView view = viewAround(origin, 1.0);
    Triangles triangles;
    for (int k = 0; k < 3; ++k) {
        const dvec2 flat = direction(random.angle()), beside = across(flat);
        const dvec3 e(flat, 0.0), f(beside * std::cos(angle), std::sin(angle));
        const dvec2 at(view.seenAt(random.around(0.3 * filter.radius), 1.0));
        const auto corner = [&](double x, double y) {
            return glm::vec3(dvec3(at, 0.0) + 2.0 * (x * e + y * f));  // of the world: shifted, not turned
        };
        const glm::vec3 a = corner(-1, random.within(0.2, 1)), b = corner(-1, -random.within(0.2, 1)),
                        c = corner(1, -random.within(0.2, 1)), d = corner(1, random.within(0.2, 1));
        triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
    }
    addBackdrop(triangles, view, random, filter.radius, 3.0);
    return throughCamera(triangles, view);
}

/// A fan whose hub lies the difficulty before or behind the near plane, and whose rim is on both its sides.
StiffScene nearPlaneVertex(double distance, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, distance);
    const CameraView view = viewAround(CameraView().seenAt(random.around(0.2 * filter.radius), 1.0), 1.0);
    const glm::vec3 hub(0.0f, 0.0f, static_cast<float>(seed % 2 ? distance : -distance));
    std::vector<glm::vec3> rim;
    for (int k = 0; k < 7; ++k)
        rim.emplace_back(dvec3(0.5 * direction(2.0 * kPi * (k + random.within(0, 0.7)) / 7.0),
                               (k % 2 ? 1.0 : -1.0) * random.within(0.1, 2.0)));
    Triangles triangles;
    for (std::size_t k = 0; k < 7; ++k) triangles.push_back({hub, rim[k], rim[(k + 1) % 7]});
    addBackdrop(triangles, view, random, filter.radius, 5.0);
    return throughCamera(triangles, view);
}

/// Quads whose planes pass the eye at the distance of the difficulty, some of them reaching behind it.
StiffScene eyeGrazing(double distance, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, distance);
    const CameraView view = viewAround({}, 1e-3);
    Triangles triangles;
    for (int k = 0; k < 4; ++k) {
        const bool upright = (seed + static_cast<std::uint64_t>(k)) % 2;
        const double tilt = random.within(-0.3, 0.3), twist = random.within(-0.3, 0.3);
        const auto corner = [&](double across_eye, double w) {
            const double off = distance * (1.0 + tilt * across_eye + twist * w);
            return upright ? dvec3(off, across_eye, -w) : dvec3(across_eye, off, -w);
        };
        addQuad(triangles, view, corner(random.within(-2, -1), random.within(1, 2)),
                corner(random.within(-2, -1), random.within(-2, 0.5)),
                corner(random.within(1, 2), random.within(-2, 0.5)),
                corner(random.within(1, 2), random.within(1, 2)));
    }
    addBackdrop(triangles, view, random, filter.radius, 4.0);
    return throughCamera(triangles, view);
}

/// Corners from the difficulty's inverse to the difficulty before the eye, and some as far behind it.
StiffScene wSpan(double span, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, span);
    const CameraView view = viewAround({}, 1e-13);
    Triangles triangles;
    for (int k = 0; k < 5; ++k) {
        const dvec2 at = random.around(0.5 * filter.radius);
        const double turn = random.angle(), size = 2.0 * filter.radius;
        std::array<dvec3, 4> corners;
        for (int c = 0; c < 4; ++c) {
            const double w = std::pow(span, random.within(-1, 1)) * (c == k ? -1.0 : 1.0);
            corners[static_cast<std::size_t>(c)] =
                view.seenAt(at + size * direction(turn + 0.5 * kPi * c), w);
        }
        addQuad(triangles, view, corners[0], corners[1], corners[2], corners[3]);
    }
    return throughCamera(triangles, view);
}

/// Quads of the difficulty's size before clipping, on, behind and through the screen, cut by the guard band.
StiffScene guardBand(double size, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, size);
    const CameraView view = viewAround({}, 1e-2);
    Triangles triangles;
    for (int k = 0; k < 5; ++k) {
        const dvec2 at = random.around(0.5 * filter.radius);
        const double turn = random.angle();
        std::array<dvec3, 4> corners;
        for (int c = 0; c < 4; ++c) {
            const double reach = c == 1 ? random.within(0, 0.5) * filter.radius : size;
            const double w = c == 2 && k % 2 ? -random.within(0.5, 2) : random.within(0.5, 2);
            corners[static_cast<std::size_t>(c)] =
                view.seenAt(at + reach * direction(turn + (0.3 + 0.4 * c) * kPi), w);
        }
        addQuad(triangles, view, corners[0], corners[1], corners[2], corners[3]);
    }
    return throughCamera(triangles, view);
}

/// A turned camera and its triangles as far from the world's origin as the difficulty says. Float32 has steps
/// of 2^-24 of that: the triangles are as large as a thousand of them, or as the eye is away.
StiffScene farWorld(double distance, const Prefilter& filter, std::uint64_t seed) {
    Random random(seed, distance);
    const double unit = std::max(1.0, 1e-4 * distance);
    const CameraView view =
        turnedView(random, distance * dvec3(1.0, random.within(-1, 1), random.within(-1, 1)), 2.0 * unit);
    Triangles triangles;
    for (int k = 0; k < 4; ++k) {
        const dvec2 at = random.around(0.5 * filter.radius);
        const double turn = random.angle(), size = 2.0 * filter.radius;
        std::array<dvec3, 4> corners;
        for (int c = 0; c < 4; ++c)
            corners[static_cast<std::size_t>(c)] =
                view.seenAt(at + size * direction(turn + 0.5 * kPi * c), unit * random.within(1.0, 5.0));
        addQuad(triangles, view, corners[0], corners[1], corners[2], corners[3]);
    }
    return throughCamera(triangles, view);
}

}  // namespace

std::vector<StabilityCase> cameraCases() {
    return {
        {"near-plane-angle", "the camera: quads through the near plane, nearly in it", "angle, radians",
         decades(-1, -15), nearPlaneAngle},
        {"near-plane-vertex", "the camera: a vertex just before or behind the near plane", "distance / near",
         decades(-1, -15), nearPlaneVertex},
        {"eye-grazing", "the camera: planes that pass the eye, seen edge-on", "distance", decades(-1, -15),
         eyeGrazing},
        {"w-span", "the camera: corners from the eye's very front to the horizon, and behind",
         "largest w, and 1 / smallest", upwards(decades(12, 1)), wSpan},
        {"guard-band", "the camera: triangles cut by the guard band, partly behind the eye", "size, px",
         upwards(decades(10, 1)), guardBand},
        {"far-world", "the camera: a turned camera far from the world's origin", "distance",
         upwards(decades(12, 0)), farWorld},
    };
}

}  // namespace edgewise::judge
