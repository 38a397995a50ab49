// The cones of some rows of pixels, and which of these something but one smooth surface may lie in.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "pipeline/field_tracer.h"
#include "pipeline/methods/edge_cell.h"
#include "sdf/ray_grid.h"

namespace edgewise {

inline constexpr std::uint32_t kNoGroup = 0xffffffffu;

/// The cones of some rows and all around them. What a pixel shows is told by its neighbours' pieces too, and
/// those by theirs.
struct ConeRows {
    static constexpr int kMargin = 2;
    PixelBox pixels;  ///< with the margin
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
    /// Not in the margin.
    bool inside(std::size_t pixel) const {
        const std::size_t x = pixel % width(), y = pixel / width(),
                          height = static_cast<std::size_t>(pixels.height());
        return x >= kMargin && x + kMargin < width() && y >= kMargin && y + kMargin < height;
    }
    /// The eight neighbours of a pixel that is not on the border.
    std::array<std::size_t, 8> around(std::size_t i) const {
        const std::size_t w = width();
        return {i - w - 1, i - w, i - w + 1, i - 1, i + 1, i + w - 1, i + w, i + w + 1};
    }
};

/// visit(part, pixels) for parts of pixels one after the other, on all threads.
inline constexpr std::size_t kPixelsInPart = 1024;
inline std::size_t partsOf(std::span<const std::size_t> pixels) {
    return (pixels.size() + kPixelsInPart - 1) / kPixelsInPart;
}
template <class Visit>
void forParts(std::span<const std::size_t> pixels, const Visit& visit) {
    tbb::parallel_for(std::size_t(0), partsOf(pixels), [&](std::size_t part) {
        const std::size_t first = part * kPixelsInPart;
        visit(part, pixels.subspan(first, std::min(kPixelsInPart, pixels.size() - first)));
    });
}

/// Of some pixels and the margin around them.
ConeRows coneRows(FieldTracer& device, const PixelBox& box);

/// Pixels, but for those on the border, that something but one smooth surface may lie in: a solid that their
/// ray misses, or what neighbours see.
std::vector<EdgeCell> doubtfulCells(const ConeRows& rows, double t_max);

}  // namespace edgewise
