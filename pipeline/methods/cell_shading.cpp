#include "pipeline/methods/cell_shading.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <span>

#include "pipeline/methods/cell_sampling.h"
#include "pipeline/methods/pattern_footprint.h"

namespace edgewise {

void CellShading::shade(const ConeRows& rows, std::vector<EdgeCell>& cells, CellShades& shades) const {
    meetPieces(cells);
    collect(rows, cells, shades);
    shades.colors = device_.shade(shades.rays, shades.hits, &shades.sights);
}

/// In Z-order, a pixel's pieces after its own hit.
void CellShading::collect(const ConeRows& rows, std::vector<EdgeCell>& cells, CellShades& shades) const {
    shades.of_pixel.assign(rows.cones.samples(), kNoGroup);
    std::vector<EdgeCell*> cell_of(rows.cones.samples(), nullptr);
    for (EdgeCell& cell : cells) cell_of[cell.pixel] = &cell;
    const std::vector<std::size_t> order = rows.zOrder(1);
    const auto eachOf = [&](std::span<const std::size_t> pixels, const auto& visit) {
        for (const std::size_t i : pixels) eachShaded(rows, i, cell_of[i], visit);
    };
    std::vector<std::size_t> begin(partsOf(order) + 1, 0);
    forParts(order, [&](std::size_t part, std::span<const std::size_t> pixels) {
        eachOf(pixels, [&](std::size_t, const sdf::SurfaceHit&, CellPiece*) { ++begin[part + 1]; });
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    shades.rays.resize(begin.back()), shades.hits.resize(begin.back());
    forParts(order, [&](std::size_t part, std::span<const std::size_t> pixels) {
        std::size_t at = begin[part];
        eachOf(pixels, [&](std::size_t i, const sdf::SurfaceHit& hit, CellPiece* piece) {
            shades.rays[at] = rows.cones.rays[i];
            if (piece) shades.rays[at].ray = grid_.ray(piece->seen_px);
            shades.hits[at] = hit;
            takePattern(rows, i, shades.hits[at]);
            (piece ? piece->shade : shades.of_pixel[i]) = static_cast<std::uint32_t>(at++);
        });
    });
    for (EdgeCell& cell : cells) cell.pieces.front().shade = shades.of_pixel[cell.pixel];
}

/// Visits what a pixel shows that can be lit: its own hit, with no piece, and its cell's other pieces.
template <class Visit>
void CellShading::eachShaded(const ConeRows& rows, std::size_t i, EdgeCell* cell, const Visit& visit) {
    const sdf::SurfaceHit* own = rows.hitOf(i);
    if (own && !(cell && cell->pieces.front().weight == 0.0)) visit(i, *own, nullptr);
    if (!cell) return;
    for (CellPiece& piece : std::span(cell->pieces).subspan(1))
        if (piece.weight != 0.0 && !piece.sky && piece.hit) visit(i, *piece.hit, &piece);
}

/// Pieces that only neighbours have met are met within their pixel.
void CellShading::meetPieces(std::vector<EdgeCell>& cells) const {
    std::vector<sdf::TravellingRay> rays;
    std::vector<double> depths;
    std::vector<std::pair<EdgeCell*, std::size_t>> pieces;
    for (EdgeCell& cell : cells)
        for (std::size_t k = 0; k < cell.pieces.size(); ++k) {
            CellPiece& piece = cell.pieces[k];
            if (piece.weight == 0.0 || piece.sky || piece.hit) continue;
            const int sample = cell.sampleOf(static_cast<int>(k));
            if (sample == EdgeCell::kUnknown) continue;
            piece.seen_px = cell.sampleAt(sample);
            rays.push_back(rayFrom(grid_, cell, piece.seen_px));
            depths.push_back(cell.depths[sample]);
            pieces.emplace_back(&cell, k);
        }
    const std::vector<sdf::SurfaceHit> hits = device_.batches().describe(rays, depths);
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (hits[i].hit) pieces[i].first->pieces[pieces[i].second].hit = hits[i];
}

/// The change of the place in the shape's frame from a pixel to the next, from neighbours on the same
/// surface.
std::optional<glm::dvec3> CellShading::stepOf(const ConeRows& rows, std::size_t i, const sdf::SurfaceHit& hit,
                                              std::size_t before, std::size_t after) const {
    const SurfacePlane own = planeOf(&hit);
    const auto local = [&](std::size_t j) -> std::optional<glm::dvec3> {
        const sdf::SurfaceHit* other = rows.hitOf(j);
        if (!other || !smoothlyOne(own, rows.planes[j], rows.radii[j])) return std::nullopt;
        return other->p_local;
    };
    const auto b = local(before), a = local(after), c = local(i);
    if (a && b) return 0.5 * (*a - *b);
    if (a && c) return *a - *c;
    if (b && c) return *c - *b;
    return std::nullopt;
}

void CellShading::takePattern(const ConeRows& rows, std::size_t i, sdf::SurfaceHit& hit) const {
    const sdf::SurfaceMaterial& material = scene_.materials[hit.material];
    if (hit.color || material.pattern == sdf::SurfaceMaterial::Pattern::kNone) return;
    const std::size_t x = i % rows.width(), y = i / rows.width(),
                      height = static_cast<std::size_t>(rows.pixels.height());
    const auto right = stepOf(rows, i, hit, x > 0 ? i - 1 : i, x + 1 < rows.width() ? i + 1 : i);
    const auto down =
        stepOf(rows, i, hit, y > 0 ? i - rows.width() : i, y + 1 < height ? i + rows.width() : i);
    if (right && down) hit.color = patternOver(material, hit, *right, *down);
}

std::vector<glm::dvec4> blended(const ConeRows& rows, const std::vector<EdgeCell>& cells,
                                const CellShades& shades, const glm::dvec4& background) {
    const auto colorOf = [&](std::uint32_t shade) {
        return shade == kNoGroup ? background : shades.colors[shade];
    };
    std::vector<glm::dvec4> colors(rows.cones.samples());
    tbb::parallel_for(std::size_t(0), colors.size(),
                      [&](std::size_t i) { colors[i] = colorOf(shades.of_pixel[i]); });
    for (const EdgeCell& cell : cells) {
        glm::dvec4 sum(0.0);
        for (const CellPiece& piece : cell.pieces)
            if (piece.weight > 0.0) sum += piece.weight * colorOf(piece.shade);
        colors[cell.pixel] = sum;
    }
    return colors;
}

}  // namespace edgewise
