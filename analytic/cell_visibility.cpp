#include "analytic/cell_visibility.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analytic/cell_overlap.h"
#include "analytic/local_plane.h"

namespace edgewise {
namespace {

/// Whether p hides q on the whole cell: its depth is greater at all four corners.
bool hides(const ScreenScene& scene, const ScreenTriangle& p, const ScreenTriangle& q, const Cell& cell) {
    if (p.plane == q.plane) return p.owner < q.owner;
    const double reach = std::max(cell.max.x - cell.min.x, cell.max.y - cell.min.y) * 1.0625;
    const LocalPlane a = localPlane(scene, p, cell.min, reach), b = localPlane(scene, q, cell.min, reach);
    const glm::dvec2 size = cell.max - cell.min;
    const double da = a.a - b.a, db = a.b - b.b;
    const double lowest = (a.c - b.c) + std::min(0.0, da * size.x) + std::min(0.0, db * size.y);
    const double border = (std::abs(da) + std::abs(db)) * (2.0 * kBorderRestPx);
    return lowest > 2.0 * (a.error + b.error) + border;
}

}  // namespace

Overlap overlap(const ScreenTriangle& t, const Cell& cell) {
    const auto& [a, b, c] = t.p_px;
    const int found =
        f64::cellOverlap(a.x, a.y, b.x, b.y, c.x, c.y, cell.min.x, cell.min.y, cell.max.x, cell.max.y);
    return {found != f64::kMisses, found == f64::kCovers};
}

void CellVisibility::run(const ScreenScene& scene, const Cell& cell,
                         std::span<const std::uint32_t> candidates, const VisibilityOptions& options,
                         CellOutput& out) {
    runPart(scene, cell, cell.min, candidates, options, out);
}

void CellVisibility::runPart(const ScreenScene& scene, const Cell& part, glm::dvec2 origin,
                             std::span<const std::uint32_t> candidates, const VisibilityOptions& options,
                             CellOutput& out) {
    stack_.assign(candidates.begin(), candidates.end());
    visit(scene, part, origin, 0, stack_.size(), options, out);
}

/// Keeps on the stack's top, of [begin, end), what meets the cell and no opaque triangle hides there. Returns
/// how many of these cover it and are seen through.
std::size_t CellVisibility::collect(const ScreenScene& scene, const Cell& cell, std::size_t begin,
                                    std::size_t end, const VisibilityOptions& options, CellOutput& out) {
    const std::size_t own = stack_.size();
    const glm::dvec2 center = 0.5 * (cell.min + cell.max);
    std::optional<std::uint32_t> occluder;
    double nearest = 0.0;
    std::size_t panes = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t index = stack_[i];
        const ScreenTriangle& t = scene.triangles[index];
        const Overlap o = overlap(t, cell);
        if (!o.meets) continue;
        stack_.push_back(index);
        if (!o.covers) continue;
        if (scene.seesThrough(t.owner)) {
            ++panes;
            continue;
        }
        const double z = localPlane(scene, t, center, 0.0).c;
        if (!occluder || z > nearest) nearest = z, occluder = index;
    }
    if (occluder && options.occlusion) out.counts.hidden += dropHidden(scene, cell, own, *occluder);
    return std::min(panes, stack_.size() - own);
}

std::size_t CellVisibility::dropHidden(const ScreenScene& scene, const Cell& cell, std::size_t from,
                                       std::uint32_t occluder) {
    const ScreenTriangle& front = scene.triangles[occluder];
    const auto hidden = [&](std::uint32_t index) {
        return index != occluder && hides(scene, front, scene.triangles[index], cell);
    };
    const auto kept =
        std::remove_if(stack_.begin() + static_cast<std::ptrdiff_t>(from), stack_.end(), hidden);
    const auto dropped = static_cast<std::size_t>(stack_.end() - kept);
    stack_.erase(kept, stack_.end());
    return dropped;
}

/// Whether the triangles on the stack from `own` are one sheet, after what sheets hide is dropped; then it is
/// emitted.
bool CellVisibility::certify(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin, std::size_t own,
                             const VisibilityOptions& options, CellOutput& out) {
    const auto list = [&] { return std::span<const std::uint32_t>(stack_).subspan(own); };
    if (std::ranges::any_of(list(),
                            [&](std::uint32_t i) { return scene.seesThrough(scene.triangles[i].owner); }))
        return false;
    shared_edges_.collect(scene, cell, list());
    if (certificate_.run(scene, cell, origin, list(), shared_edges_, out)) return true;
    if (!options.occlusion || !options.sheets || list().size() < 2) return false;
    const auto hidden = sheet_occlusion_.hidden(scene, cell, list(), shared_edges_);
    if (std::ranges::find(hidden, 1) == hidden.end()) return false;
    std::size_t kept = own;
    for (std::size_t i = 0; i < hidden.size(); ++i)
        if (hidden[i] == 0) stack_[kept++] = stack_[own + i];
    out.counts.hidden += stack_.size() - kept;
    stack_.resize(kept);
    shared_edges_.collect(scene, cell, list());
    return certificate_.run(scene, cell, origin, list(), shared_edges_, out);
}

void CellVisibility::visit(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin, std::size_t begin,
                           std::size_t end, const VisibilityOptions& options, CellOutput& out) {
    const std::size_t own = stack_.size();
    const std::size_t panes = collect(scene, cell, begin, end, options, out);
    if (options.certify && certify(scene, cell, origin, own, options, out)) {
        stack_.resize(own);
        return;
    }
    const std::size_t count = stack_.size() - own;
    const auto list = [&] { return std::span<const std::uint32_t>(stack_).subspan(own, count); };
    const glm::dvec2 size = cell.max - cell.min, center = 0.5 * (cell.min + cell.max);
    // Panes bring no edges into the cell, and a smaller one would hold them all the same.
    const bool crowded = count - panes > static_cast<std::size_t>(options.max_triangles);
    if (crowded && size.x > options.min_cell_px) {
        const double xs[3] = {cell.min.x, center.x, cell.max.x}, ys[3] = {cell.min.y, center.y, cell.max.y};
        for (std::size_t quarter = 0; quarter < 4; ++quarter) {
            const std::size_t i = quarter & 1, j = quarter >> 1;
            visit(scene, {{xs[i], ys[j]}, {xs[i + 1], ys[j + 1]}}, origin, own, own + count, options, out);
        }
    } else if (options.by_edges) {
        by_edges_.run(scene, cell, origin, list(), out);
    } else {
        sweep_.run(scene, cell, origin, list(), options, out);
    }
    stack_.resize(own);
}

}  // namespace edgewise
