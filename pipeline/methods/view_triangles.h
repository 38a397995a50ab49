// The screen triangles as a ray tracer in float32 wants them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "analytic/screen_triangle.h"
#include "pipeline/film.h"

namespace edgewise {

/// Which ray sees a screen position, in a space where the depth of the screen triangles is linear:
///
///     perspective    (X, Y, W) = ((x - c) s w, (y - c) s w, w), w = d / depth;  the ray is t (X/W, Y/W, 1)
///     orthographic   (X, Y, Z) = ((x - c) s, (y - c) s, 1 + (front - depth) d); the ray is (X, Y, t)
///
/// so that along a ray t orders as depth does, the nearest first, and a vertex's screen position keeps
/// float32's 2^-24 of half the film's longer side. Homogeneous coordinates and not depth along an
/// axis: 1/w would round to 2^-24 of the *nearest* depth, and far surfaces would fight; w rounds to 2^-24 of
/// itself. c is the film's centre and s a power of 2, neither of which knows of crops.
struct RayView {
    bool perspective = true;
    glm::dvec2 centre_px{0.0};
    double per_px = 1.0;
    double depth_scale = 1.0, front = 0.0;

    glm::dvec3 point(glm::dvec2 p_px, double depth) const;
    glm::dvec2 direction(glm::dvec2 p_px) const { return (p_px - centre_px) * per_px; }
};

/// Triangles that share a vertex share its index, so that no ray slips between them.
struct ViewTriangles {
    std::vector<glm::vec3> vertices;
    std::vector<glm::u32vec3> corners;
    std::vector<std::uint32_t> triangle;  ///< each one's, in ScreenScene::triangles
};

struct ViewScene {
    RayView view;
    ViewTriangles opaque, see_through;
};

/// What of a scene meets the film and `margin_px` around it. What reaches farther than the film's own size
/// beyond is cut there, since float32 would move its edges.
ViewScene viewTriangles(const ScreenScene& screen, const Film& film, bool perspective, int margin_px);

/// The depth plane at a position, rounded.
double depthAt(const ScreenScene& screen, const ScreenTriangle& triangle, glm::dvec2 p_px);

}  // namespace edgewise
