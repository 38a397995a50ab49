// Silhouettes of one scene made twice, compared in pixels: where the film changes between something and
// nothing.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise::judge {

/// Whether something is seen at a place of the film. Safe for many threads at once.
using FilmMask = std::function<bool(const glm::dvec2& p_px)>;

/// What `sphere` sees of an SDF scene: its rays, its threshold. Refers to the input, which outlives it.
FilmMask fieldMask(const MethodInput& input);
/// What is seen of triangles, exactly.
FilmMask triangleMask(const Scene& triangles, const ResolvedCamera& camera, const Film& film);

/// Where the mask changes between the centres of neighbouring pixels, by bisection to 2^-12 px. Parts that
/// lie between all centres have none.
std::vector<glm::dvec2> contourPoints(const FilmMask& mask, const PixelBox& box);

/// How far a place is from where the mask changes, at most: such a place is found on rays from it. Infinite
/// where none is within kFarthestContourPx.
inline constexpr double kFarthestContourPx = 4.0;
double distanceToContour(const FilmMask& mask, const glm::dvec2& p_px);

/// Largest distances from one's contour points to the other's contour.
struct SilhouetteDistance {
    double first_to_second_px = 0.0, second_to_first_px = 0.0;
    double mean_px = 0.0;  ///< over both ways
    std::size_t first_points = 0, second_points = 0;
    glm::dvec2 worst_px{0.0};  ///< where the largest is
    double worst() const { return std::max(first_to_second_px, second_to_first_px); }
};
SilhouetteDistance silhouetteDistance(const FilmMask& first, const FilmMask& second, const PixelBox& box);

}  // namespace edgewise::judge
