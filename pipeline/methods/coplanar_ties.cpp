#include "pipeline/methods/coplanar_ties.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <mutex>
#include <numeric>
#include <span>

#include "pipeline/grid_orientation.h"

namespace edgewise {
namespace {

constexpr int kMostCellsPerSide = 1024;
constexpr std::size_t kMostCellsPerTriangle = 8;  ///< on average: else the lattice is halved

struct Box {
    glm::dvec2 low, high;
    explicit Box(const ScreenTriangle& t)
        : low(glm::min(glm::min(t.p_px[0], t.p_px[1]), t.p_px[2])),
          high(glm::max(glm::max(t.p_px[0], t.p_px[1]), t.p_px[2])) {}
    bool overlaps(const Box& o) const {
        return low.x < o.high.x && o.low.x < high.x && low.y < o.high.y && o.low.y < high.y;
    }
};

/// Whether all of `other` lies outside an edge of `t`, or on it.
bool edgeParts(const ScreenTriangle& t, const ScreenTriangle& other) {
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], b = t.p_px[(k + 1) % 3];
        if (std::ranges::all_of(other.p_px, [&](glm::dvec2 p) { return gridOrientation(a, b, p) <= 0; }))
            return true;
    }
    return false;
}

/// Triangles that share an edge or a corner do not.
bool overlap(const ScreenTriangle& s, const ScreenTriangle& t) {
    return Box(s).overlaps(Box(t)) && !edgeParts(s, t) && !edgeParts(t, s);
}

/// A point on an edge belongs to the triangle whose top or left edge it is.
bool covers(const ScreenTriangle& t, glm::dvec2 p) {
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], b = t.p_px[(k + 1) % 3];
        const int side = gridOrientation(a, b, p);
        const bool top_or_left = a.y == b.y ? b.x > a.x : b.y < a.y;
        if (top_or_left ? side < 0 : side <= 0) return false;
    }
    return true;
}

}  // namespace

int CoplanarTies::Sheet::cellAt(double from_low_px, double per_px) const {
    return static_cast<int>(std::clamp(std::floor(from_low_px * per_px), 0.0, double(side - 1)));
}

template <class Visit>
void CoplanarTies::Sheet::forCells(const ScreenTriangle& triangle, const Visit& visit) const {
    const Box box(triangle);
    const glm::dvec2 low = box.low - low_px, high = box.high - low_px;
    for (int y = cellAt(low.y, cells_per_px.y); y <= cellAt(high.y, cells_per_px.y); ++y)
        for (int x = cellAt(low.x, cells_per_px.x); x <= cellAt(high.x, cells_per_px.x); ++x)
            visit(static_cast<std::size_t>(y) * side + x);
}

/// Planes of one owner alone are left out; the others are looked at in parallel.
CoplanarTies::CoplanarTies(const ScreenScene& screen) : screen_(screen) {
    const auto opaque = [&](const ScreenTriangle& t) { return !screen.seesThrough(t.owner); };
    std::vector<std::size_t> begin(screen.planes.size() + 1, 0);
    for (const ScreenTriangle& t : screen.triangles)
        if (opaque(t)) ++begin[t.plane + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    Ids by_plane(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < screen.triangles.size(); ++i)
        if (const ScreenTriangle& t = screen.triangles[i]; opaque(t)) by_plane[next[t.plane]++] = i;

    std::vector<std::uint8_t> hidden(screen.triangles.size(), 0);
    std::mutex mutex;
    tbb::parallel_for(std::size_t{0}, screen.planes.size(), [&](std::size_t plane) {
        const auto ids = std::span(by_plane).subspan(begin[plane], begin[plane + 1] - begin[plane]);
        if (ids.empty() || screen.triangles[ids.front()].owner == screen.triangles[ids.back()].owner) return;
        Sheet sheet = sheetOf({ids.begin(), ids.end()});
        tbb::parallel_for(std::size_t{0}, ids.size(),
                          [&](std::size_t i) { hidden[ids[i]] = isHidden(ids[i], sheet); });
        if (std::ranges::none_of(ids, [&](std::uint32_t id) { return hidden[id] != 0; })) return;
        const std::lock_guard lock(mutex);
        sheets_.emplace(static_cast<std::uint32_t>(plane), std::move(sheet));
    });
    if (!sheets_.empty()) hidden_ = std::move(hidden);
}

/// About a cell a triangle; fewer where triangles meet many.
CoplanarTies::Sheet CoplanarTies::sheetOf(const Ids& ids) const {
    Sheet sheet;
    Box all(screen_.triangles[ids.front()]);
    for (const std::uint32_t id : ids) {
        const Box box(screen_.triangles[id]);
        all.low = glm::min(all.low, box.low), all.high = glm::max(all.high, box.high);
    }
    sheet.low_px = all.low;
    sheet.side = std::min(kMostCellsPerSide, static_cast<int>(std::sqrt(double(ids.size()))));
    for (;; sheet.side /= 2) {
        sheet.cells_per_px = double(sheet.side) / glm::max(all.high - all.low, glm::dvec2(kGridPx));
        std::size_t entries = 0;
        for (const std::uint32_t id : ids)
            sheet.forCells(screen_.triangles[id], [&](std::size_t) { ++entries; });
        if (sheet.side == 1 || entries <= kMostCellsPerTriangle * ids.size()) break;
    }
    fillCells(ids, sheet);
    return sheet;
}

/// Count, scan, fill.
void CoplanarTies::fillCells(const Ids& ids, Sheet& sheet) const {
    sheet.begin.assign(static_cast<std::size_t>(sheet.side) * sheet.side + 1, 0);
    for (const std::uint32_t id : ids)
        sheet.forCells(screen_.triangles[id], [&](std::size_t cell) { ++sheet.begin[cell + 1]; });
    std::partial_sum(sheet.begin.begin(), sheet.begin.end(), sheet.begin.begin());
    sheet.ids.resize(sheet.begin.back());
    std::vector<std::size_t> next(sheet.begin.begin(), sheet.begin.end() - 1);
    for (const std::uint32_t id : ids)
        sheet.forCells(screen_.triangles[id], [&](std::size_t cell) { sheet.ids[next[cell]++] = id; });
}

bool CoplanarTies::isHidden(std::uint32_t id, const Sheet& sheet) const {
    const ScreenTriangle& t = screen_.triangles[id];
    bool hidden = false;
    sheet.forCells(t, [&](std::size_t cell) {
        for (std::size_t i = sheet.begin[cell]; !hidden && i < sheet.begin[cell + 1]; ++i) {
            const ScreenTriangle& other = screen_.triangles[sheet.ids[i]];
            if (other.owner >= t.owner) break;
            hidden = overlap(other, t);
        }
    });
    return hidden;
}

std::uint32_t CoplanarTies::lowestAt(std::uint32_t found, glm::dvec2 p_px) const {
    const Sheet& sheet = sheets_.at(screen_.triangles[found].plane);
    const glm::dvec2 from_low = p_px - sheet.low_px;
    const std::size_t cell =
        static_cast<std::size_t>(sheet.cellAt(from_low.y, sheet.cells_per_px.y)) * sheet.side +
        sheet.cellAt(from_low.x, sheet.cells_per_px.x);
    for (std::size_t i = sheet.begin[cell]; i < sheet.begin[cell + 1] && sheet.ids[i] < found; ++i)
        if (covers(screen_.triangles[sheet.ids[i]], p_px)) return sheet.ids[i];
    return found;
}

}  // namespace edgewise
