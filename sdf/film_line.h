// Straight edges as they lie on the film.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "sdf/ray_grid.h"

namespace edgewise::sdf {

/// at(q) is q's distance from a line of the film in pixels, negative on its inner side.
struct FilmLine {
    double a = 0.0, b = 0.0, c = 0.0;  ///< a^2 + b^2 = 1
    double at(const glm::dvec2& q_px) const { return a * q_px.x + b * q_px.y + c; }
    FilmLine reversed() const { return {-a, -b, -c}; }
};

/// The outline of a solid that a ray passes by: through `edge_world`, a point of its surface, where
/// `outwards_world` leads away from it. Exact for straight edges. None where it points along the view.
std::optional<FilmLine> outline(const RayGrid& grid, const glm::dvec3& edge_world,
                                const glm::dvec3& outwards_world);

/// Where two planes meet, each by a point and its normal. None where they are parallel or meet in a point of
/// the film.
std::optional<FilmLine> crease(const RayGrid& grid, const glm::dvec3& p_world, const glm::dvec3& n_world,
                               const glm::dvec3& other_p_world, const glm::dvec3& other_n_world);

/// Where a point is seen.
glm::dvec2 filmPosition(const RayGrid& grid, const glm::dvec3& p_world);

/// The part of a square of side 1 that lies on the inner side of all lines.
std::vector<glm::dvec2> squareWithin(const glm::dvec2& centre_px, std::span<const FilmLine> lines);
/// The part of a convex polygon on the line's inner side.
std::vector<glm::dvec2> within(std::span<const glm::dvec2> polygon, const FilmLine& line);
/// Whether a convex polygon holds the point.
bool holds(std::span<const glm::dvec2> polygon, const glm::dvec2& p_px);
double areaOf(std::span<const glm::dvec2> polygon);
glm::dvec2 centroidOf(std::span<const glm::dvec2> polygon);

}  // namespace edgewise::sdf
