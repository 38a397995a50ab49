#include "sdf/film_line.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace edgewise::sdf {
namespace {

/// An affine function of the film, from its values at the grid's corner and along a pixel to the right and
/// down.
std::optional<FilmLine> lineOf(double right, double down, double corner) {
    const double size = std::hypot(right, down);
    if (!(size > 0.0) || !std::isfinite(corner / size)) return std::nullopt;
    return FilmLine{right / size, down / size, corner / size};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

}  // namespace

/// All rays that touch the edge there lie in the plane through the eye whose normal is outwards, the view's
/// part taken out.
std::optional<FilmLine> outline(const RayGrid& grid, const glm::dvec3& edge_world,
                                const glm::dvec3& outwards_world) {
    const glm::dvec3 view = grid.perspective ? glm::normalize(edge_world - grid.eye_world) : grid.axis_world;
    const glm::dvec3 across = outwards_world - view * glm::dot(outwards_world, view);
    const glm::dvec3 origin = grid.perspective ? glm::dvec3(0.0) : edge_world;
    return lineOf(glm::dot(grid.right_world, across), glm::dot(grid.down_world, across),
                  glm::dot(grid.corner_world - origin, across));
}

/// Of the planes through the meeting line, the one that holds the eye, or the orthographic axis.
std::optional<FilmLine> crease(const RayGrid& grid, const glm::dvec3& p_world, const glm::dvec3& n_world,
                               const glm::dvec3& other_p_world, const glm::dvec3& other_n_world) {
    if (grid.perspective) {
        const double eye = glm::dot(grid.eye_world - p_world, n_world),
                     other_eye = glm::dot(grid.eye_world - other_p_world, other_n_world);
        const auto along = [&](const glm::dvec3& v) {
            return glm::dot(v, n_world) * other_eye - glm::dot(v, other_n_world) * eye;
        };
        return lineOf(along(grid.right_world), along(grid.down_world), along(grid.corner_world));
    }
    const double fall = glm::dot(grid.axis_world, n_world),
                 other_fall = glm::dot(grid.axis_world, other_n_world);
    const auto along = [&](const glm::dvec3& v) {
        return glm::dot(v, n_world) * other_fall - glm::dot(v, other_n_world) * fall;
    };
    const double corner = glm::dot(grid.corner_world - p_world, n_world) * other_fall -
                          glm::dot(grid.corner_world - other_p_world, other_n_world) * fall;
    return lineOf(along(grid.right_world), along(grid.down_world), corner);
}

glm::dvec2 filmPosition(const RayGrid& grid, const glm::dvec3& p_world) {
    glm::dvec3 on_plane = p_world - grid.corner_world;
    if (grid.perspective) {
        const glm::dvec3 v = p_world - grid.eye_world;
        on_plane = v / glm::dot(v, grid.axis_world) - grid.corner_world;
    }
    return {glm::dot(on_plane, grid.right_world) / glm::dot(grid.right_world, grid.right_world),
            glm::dot(on_plane, grid.down_world) / glm::dot(grid.down_world, grid.down_world)};
}

std::vector<glm::dvec2> squareWithin(const glm::dvec2& centre_px, std::span<const FilmLine> lines) {
    std::vector<glm::dvec2> polygon;
    for (const glm::dvec2& corner : {glm::dvec2(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        polygon.push_back(centre_px + corner);
    for (const FilmLine& line : lines) polygon = within(polygon, line);
    return polygon;
}

std::vector<glm::dvec2> within(std::span<const glm::dvec2> polygon, const FilmLine& line) {
    std::vector<glm::dvec2> inner;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = line.at(p), at_q = line.at(q);
        if (at_p <= 0.0) inner.push_back(p);
        if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0))
            inner.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    return inner;
}

/// On the same side of all edges, whichever way they turn.
bool holds(std::span<const glm::dvec2> polygon, const glm::dvec2& p) {
    bool left = false, right = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const double side = cross(polygon[(i + 1) % polygon.size()] - polygon[i], p - polygon[i]);
        left |= side > 0.0, right |= side < 0.0;
    }
    return polygon.size() > 2 && !(left && right);
}

/// From the first corner, so that far polygons cancel nothing.
double areaOf(std::span<const glm::dvec2> polygon) {
    double twice = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * std::abs(twice);
}

glm::dvec2 centroidOf(std::span<const glm::dvec2> polygon) {
    glm::dvec2 sum(0.0);
    double size = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
        sum += cross(a, b) * (a + b) / 3.0, size += cross(a, b);
    }
    return polygon[0] + (size != 0.0 ? sum / size : glm::dvec2(0.0));
}

}  // namespace edgewise::sdf
