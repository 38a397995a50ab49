// Which samples a triangle is gathered for: exactly, and as the paper rasterizes it (NSAA, section 3.1).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "pipeline/film.h"

namespace edgewise::figures {

using Corners = std::array<glm::dvec2, 3>;  ///< px; not on one line

/// x of the part of a row, from low to high.
struct RowPart {
    double low, high;
};

/// P_cons: points within h of the triangle, on the row y.
std::optional<RowPart> withinReach(const Corners& triangle, double h, double y);
std::optional<RowPart> rowOf(const Corners& triangle, double y);

struct Incircle {
    glm::dvec2 centre;
    double radius;
};
Incircle incircleOf(const Corners& triangle);
/// Scaled about the incircle's centre by (r + h)/r, which moves every edge outwards by h.
Corners thickened(const Corners& triangle, double h);

/// Samples (at pixels' middles) of a film.
struct GatherCounts {
    std::uint64_t needed = 0;     ///< within h of the triangle
    std::uint64_t thickened = 0;  ///< of the thickened triangle
    std::uint64_t clipped = 0;    ///< of it, within the smallest box that holds P_cons
    std::uint64_t covered = 0;    ///< of the triangle itself
    GatherCounts& operator+=(const GatherCounts& other);
};
GatherCounts gatherCounts(const Corners& triangle, double h, const PixelBox& film);

}  // namespace edgewise::figures
