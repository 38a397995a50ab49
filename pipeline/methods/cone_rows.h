// The cones of some rows of pixels, and which of these something but one smooth surface may lie in.
#pragma once

#include <array>

#include "pipeline/field_tracer.h"
#include "pipeline/methods/edge_cell.h"
#include "sdf/ray_grid.h"

namespace edgewise {

inline constexpr std::uint32_t kNoGroup = 0xffffffffu;

/// The cones of some rows and all around them.
struct ConeRows {
    PixelBox pixels;  ///< with a margin of one
    FieldCones cones;
    std::vector<std::uint32_t> hard;   ///< a pixel: the group that its ray meets, or kNoGroup
    std::vector<char> soft;            ///< a group lies before that
    std::vector<SurfacePlane> planes;  ///< what the pixel's ray meets
    std::vector<double> radii;         ///< a pixel's radius there

    std::size_t width() const { return static_cast<std::size_t>(pixels.width()); }
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y - pixels.y0) * width() + static_cast<std::size_t>(x - pixels.x0);
    }
    glm::dvec2 centreOf(std::size_t pixel) const {
        return {pixels.x0 + static_cast<double>(pixel % width()) + 0.5,
                pixels.y0 + static_cast<double>(pixel / width()) + 0.5};
    }
    const sdf::SurfaceHit* hitOf(std::size_t pixel) const {
        return hard[pixel] == kNoGroup ? nullptr : &cones.surfaces[hard[pixel]];
    }
    /// No surface lies before it in the pixel.
    double startOf(std::size_t pixel, double t_max) const {
        const std::uint32_t first = cones.begin[pixel];
        return first < cones.begin[pixel + 1] ? cones.groups[first].entry : t_max;
    }
    /// Pixels but for a border of that width, near ones near each other: their rays travel together.
    std::vector<std::size_t> zOrder(std::size_t border) const;
    /// The eight neighbours of a pixel that is not in the margin.
    std::array<std::size_t, 8> around(std::size_t i) const {
        const std::size_t w = width();
        return {i - w - 1, i - w, i - w + 1, i - 1, i + 1, i + w - 1, i + w, i + w + 1};
    }
};

/// Of the pixels, which have a margin.
ConeRows coneRows(FieldTracer& device, const PixelBox& pixels);

/// Pixels, without the margin, that something but one smooth surface may lie in: a solid that their ray
/// misses, or what neighbours see.
std::vector<EdgeCell> doubtfulCells(const ConeRows& rows, double t_max);

}  // namespace edgewise
