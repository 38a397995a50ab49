#include "pipeline/methods/cone_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace edgewise {
namespace {

/// Neighbours that see other surfaces than the pixel does.
std::vector<std::size_t> strangersOf(const ConeRows& rows, std::size_t i) {
    std::vector<std::size_t> strangers;
    for (const std::size_t j : rows.around(i))
        if (!smoothlyOne(rows.planes[i], rows.planes[j], std::max(rows.radii[i], rows.radii[j])))
            strangers.push_back(j);
    return strangers;
}

/// Of the pixel's surface, as its other neighbours tell.
double bendOf(const ConeRows& rows, std::size_t i, const std::vector<std::size_t>& strangers) {
    double bend = 0.0;
    for (const std::size_t j : rows.around(i))
        if (std::ranges::find(strangers, j) == strangers.end())
            bend = std::max(bend, bendBetween(rows.planes[i], rows.planes[j]));
    return bend;
}

std::optional<EdgeCell> doubtfulCell(const ConeRows& rows, std::size_t i, double t_max) {
    const std::vector<std::size_t> strangers = strangersOf(rows, i);
    if (!rows.soft[i] && strangers.empty()) return std::nullopt;
    const sdf::SurfaceHit* own = rows.hitOf(i);
    EdgeCell cell;
    cell.pixel = i, cell.centre_px = rows.centreOf(i), cell.sign = rows.cones.rays[i].sign;
    cell.pieces.push_back(pieceOf(rows.planes[i], cell.centre_px));
    cell.pieces.front().bend = bendOf(rows, i, strangers);
    if (own) cell.pieces.front().hit = *own;
    cell.depths[0] = own ? own->t : HUGE_VAL;
    cell.t_start = rows.startOf(i, t_max);
    if (rows.soft[i]) cell.soft_t = rows.cones.groups[rows.cones.begin[i]].entry;
    for (const std::size_t j : strangers)
        if (std::ranges::none_of(cell.pieces, [&](const CellPiece& p) {
                return smoothlyOne(p, rows.planes[j], rows.radii[i]);
            }))
            cell.pieces.push_back(pieceOf(rows.planes[j], rows.centreOf(j)));
    return cell;
}

/// Side of the squares that zOrder() goes through one after the other, each along a Z-order curve.
constexpr std::uint32_t kSquare = 64;

/// Every other bit of 12.
std::uint32_t evenBits(std::uint32_t m) {
    m &= 0x555u;
    m = (m | m >> 1) & 0x333u;
    m = (m | m >> 2) & 0xf0fu;
    return (m | m >> 4) & 0x3fu;
}

}  // namespace

std::vector<std::size_t> ConeRows::zOrder(std::size_t border) const {
    const std::size_t right = width() - border, bottom = static_cast<std::size_t>(pixels.height()) - border;
    std::vector<std::size_t> order;
    for (std::size_t y0 = border; y0 < bottom; y0 += kSquare)
        for (std::size_t x0 = border; x0 < right; x0 += kSquare)
            for (std::uint32_t m = 0; m < kSquare * kSquare; ++m) {
                const std::size_t x = x0 + evenBits(m), y = y0 + evenBits(m >> 1);
                if (x < right && y < bottom) order.push_back(y * width() + x);
            }
    return order;
}

ConeRows coneRows(FieldTracer& device, const PixelBox& box) {
    constexpr int m = ConeRows::kMargin;
    const PixelBox pixels{box.x0 - m, box.y0 - m, box.x1 + m, box.y1 + m};
    ConeRows rows;
    rows.pixels = pixels;
    FieldWindow window;
    window.pixels = pixels;
    rows.cones = device.traceCones(window);
    const std::size_t count = rows.cones.samples();
    rows.hard.assign(count, kNoGroup), rows.soft.assign(count, 0);
    rows.planes.resize(count), rows.radii.resize(count);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
        const std::uint32_t end = rows.cones.begin[i + 1];
        std::uint32_t g = rows.cones.begin[i];
        while (g < end && !rows.cones.groups[g].hard) ++g;
        rows.soft[i] = g > rows.cones.begin[i];
        if (g < end) rows.hard[i] = g;
        const sdf::SurfaceHit* hit = rows.hitOf(i);
        const sdf::FieldRay& ray = rows.cones.rays[i].ray;
        rows.planes[i] = planeOf(hit);
        rows.radii[i] = ray.pixel_radius + ray.pixel_slope * (hit ? hit->t : 0.0);
    });
    return rows;
}

std::vector<EdgeCell> doubtfulCells(const ConeRows& rows, double t_max) {
    const std::vector<std::size_t> order = rows.zOrder(1);
    std::vector<std::vector<EdgeCell>> parts(partsOf(order));
    forParts(order, [&](std::size_t p, std::span<const std::size_t> pixels) {
        for (const std::size_t i : pixels)
            if (auto cell = doubtfulCell(rows, i, t_max)) parts[p].push_back(std::move(*cell));
    });
    std::vector<EdgeCell> cells;
    for (std::vector<EdgeCell>& part : parts)
        cells.insert(cells.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
    return cells;
}

}  // namespace edgewise
