#include "analytic/sheet_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "analytic/local_plane.h"

namespace edgewise {
namespace {

/// Bounds of a triangle's depth over what of it lies in the cell.
struct DepthRange {
    double farthest, nearest;
};

/// The depth is affine: the cell's corners bound it, and the triangle's vertices do.
DepthRange depthRange(const ScreenScene& scene, const ScreenTriangle& t, const Cell& cell) {
    const glm::dvec2 size = cell.max - cell.min;
    const LocalPlane p = localPlane(scene, t, cell.min, std::max(size.x, size.y) * 1.0625);
    const double slack = 2.0 * p.error + (std::abs(p.a) + std::abs(p.b)) * (2.0 * kBorderRestPx);
    const double ax = p.a * size.x, by = p.b * size.y;
    const DepthRange corners{p.c + std::min(0.0, ax) + std::min(0.0, by) - slack,
                             p.c + std::max(0.0, ax) + std::max(0.0, by) + slack};
    DepthRange vertices{HUGE_VAL, -HUGE_VAL};
    for (const glm::dvec2& p_px : t.p_px) {
        const glm::dvec2 v = p_px - cell.min;
        const double depth = depthAt(p, v.x, v.y);
        // Roundings beyond the cell's own bound: the vertex may lie far outside.
        const double error =
            p.error + 8.0 * 0x1p-53 * (std::abs(p.a) * std::abs(v.x) + std::abs(p.b) * std::abs(v.y));
        vertices.farthest = std::min(vertices.farthest, depth - error);
        vertices.nearest = std::max(vertices.nearest, depth + error);
    }
    return {std::max(corners.farthest, vertices.farthest), std::min(corners.nearest, vertices.nearest)};
}

}  // namespace

std::uint32_t SheetOcclusion::sheetOf(std::uint32_t place) {
    while (parent_[place] != place) place = parent_[place] = parent_[parent_[place]];
    return place;
}

void SheetOcclusion::findSheets(const SharedEdges& shared, std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0u);
    open_.assign(shared.surplus().begin(), shared.surplus().end());
    for (const SharedEdge& e : shared.edges()) {
        if (e.with == SharedEdge::kUnused || e.against == SharedEdge::kUnused)
            open_[std::min(e.with, e.against)] = 1;
        else
            parent_[sheetOf(e.with)] = sheetOf(e.against);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        if (open_[i] != 0) open_[sheetOf(i)] = 1;
}

void SheetOcclusion::findCovering(const ScreenScene& scene, const Cell& cell,
                                  std::span<const std::uint32_t> triangles) {
    covers_.assign(triangles.size(), 0);
    const auto points = genericPoints(cell);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t sheet = sheetOf(i);
        if (open_[sheet] != 0 || covers_[sheet] != 0) continue;
        const ScreenTriangle& t = scene.triangles[triangles[i]];
        covers_[sheet] = std::ranges::any_of(points, [&](glm::dvec2 p) { return sideOfTriangle(t, p) > 0; });
    }
}

std::span<const std::uint8_t> SheetOcclusion::hidden(const ScreenScene& scene, const Cell& cell,
                                                     std::span<const std::uint32_t> triangles,
                                                     const SharedEdges& shared) {
    findSheets(shared, triangles.size());
    findCovering(scene, cell, triangles);
    if (std::ranges::find(covers_, 1) == covers_.end()) return {};
    nearest_.resize(triangles.size());
    farthest_.assign(triangles.size(), HUGE_VAL);  // by a sheet's root from here on
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const DepthRange range = depthRange(scene, scene.triangles[triangles[i]], cell);
        nearest_[i] = range.nearest;
        double& farthest = farthest_[sheetOf(i)];
        farthest = std::min(farthest, range.farthest);
    }
    std::optional<std::uint32_t> front;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        if (covers_[i] != 0 && (!front || farthest_[i] > farthest_[*front])) front = i;
    hidden_.assign(triangles.size(), 0);
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        hidden_[i] = nearest_[i] < farthest_[*front];  // never of the sheet itself
    return hidden_;
}

}  // namespace edgewise
