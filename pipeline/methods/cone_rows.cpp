#include "pipeline/methods/cone_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace edgewise {
namespace {

std::optional<EdgeCell> doubtfulCell(const ConeRows& rows, std::size_t i, double t_max) {
    const sdf::SurfaceHit* own = rows.hitOf(i);
    CellPiece centre = pieceOf(own, rows.centreOf(i));
    const double radius = rows.radiusOf(i);
    bool doubtful = rows.soft[i];
    std::vector<CellPiece> others;
    for (const std::size_t j : rows.around(i)) {
        const CellPiece other = pieceOf(rows.hitOf(j), rows.centreOf(j));
        if (smoothlyOne(centre, other, std::max(radius, rows.radiusOf(j)))) {
            takeBend(centre, other);
            continue;
        }
        doubtful = true;
        others.push_back(other);
    }
    if (!doubtful) return std::nullopt;
    EdgeCell cell;
    cell.pixel = i, cell.centre_px = rows.centreOf(i), cell.sign = rows.cones.rays[i].sign;
    cell.pieces.push_back(centre);
    if (own) cell.pieces.front().hit = *own;
    cell.depths[0] = own ? own->t : HUGE_VAL;
    const std::uint32_t first = rows.cones.begin[i];
    cell.t_start = rows.startOf(i, t_max);
    if (rows.soft[i]) cell.soft_t = rows.cones.groups[first].entry;
    for (const CellPiece& other : others)
        if (std::ranges::none_of(cell.pieces,
                                 [&](const auto& p) { return smoothlyOne(p, other, rows.radiusOf(i)); }))
            cell.pieces.push_back(other);
    return cell;
}

}  // namespace

ConeRows coneRows(FieldTracer& device, const PixelBox& pixels) {
    ConeRows rows;
    rows.pixels = pixels;
    FieldWindow window;
    window.pixels = pixels;
    rows.cones = device.traceCones(window);
    const std::size_t count = rows.cones.samples();
    rows.hard.assign(count, kNoGroup), rows.soft.assign(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t end = rows.cones.begin[i + 1];
        std::uint32_t g = rows.cones.begin[i];
        while (g < end && !rows.cones.groups[g].hard) ++g;
        rows.soft[i] = g > rows.cones.begin[i];
        if (g < end) rows.hard[i] = g;
    }
    return rows;
}

std::vector<EdgeCell> doubtfulCells(const ConeRows& rows, double t_max) {
    const std::size_t height = static_cast<std::size_t>(rows.pixels.height()), width = rows.width();
    std::vector<std::vector<EdgeCell>> by_row(height);
    tbb::parallel_for(std::size_t(1), height - 1, [&](std::size_t y) {
        for (std::size_t x = 1; x + 1 < width; ++x)
            if (auto cell = doubtfulCell(rows, y * width + x, t_max)) by_row[y].push_back(std::move(*cell));
    });
    std::vector<EdgeCell> cells;
    for (std::vector<EdgeCell>& row : by_row)
        cells.insert(cells.end(), std::make_move_iterator(row.begin()), std::make_move_iterator(row.end()));
    return cells;
}

}  // namespace edgewise
