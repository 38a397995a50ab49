#include "pipeline/methods/cell_lights.h"

#include <algorithm>

#include "pipeline/methods/light_borders.h"
#include "sdf/film_line.h"

namespace edgewise {

CellLights::CellLights(const sdf::RayGrid& grid, const sdf::FieldScene& scene, FieldTracer& device,
                       const ConeRows& rows, const std::vector<EdgeCell>& cells)
    : grid_(grid),
      scene_(scene),
      device_(device),
      rows_(rows),
      cells_(cells),
      cell_of_(rows.cones.samples(), nullptr) {
    for (const EdgeCell& cell : cells) cell_of_[cell.pixel] = &cell;
}

/// Whether the surface of that shade has another sight in a neighbour, or in the middle of the pixel.
bool CellLights::seesOther(const CellShades& shades, std::size_t pixel, std::uint32_t shade,
                           const SurfacePlane& plane) const {
    const auto differs = [&](std::uint32_t other, const SurfacePlane& there, std::size_t j) {
        return other != kNoGroup && shades.sights[other] != shades.sights[shade] &&
               smoothlyOne(plane, there, rows_.radii[j]);
    };
    if (differs(shades.of_pixel[pixel], rows_.planes[pixel], pixel)) return true;
    return std::ranges::any_of(rows_.around(pixel), [&](std::size_t j) {
        if (differs(shades.of_pixel[j], rows_.planes[j], j)) return true;
        return cell_of_[j] && std::ranges::any_of(cell_of_[j]->pieces, [&](const CellPiece& piece) {
                   return piece.weight > 0.0 && differs(piece.shade, piece, j);
               });
    });
}

/// The standard locations that the piece has; else a place within it.
std::vector<glm::dvec2> CellLights::placesOf(const EdgeCell& cell, int piece) const {
    std::vector<glm::dvec2> places;
    for (const CellPart& part : cell.parts) {
        if (part.piece != piece) continue;
        for (int i = 0; i < EdgeCell::kStandard; ++i) {
            const glm::dvec2 place = countedPlace(cell.centre_px, i);
            const bool counted = part.share < 1.0 && cell.labels[1 + EdgeCell::kCorners + i] != piece;
            if (!counted && sdf::holds(part.polygon_px, place)) places.push_back(place);
        }
    }
    if (places.empty()) places.push_back(cell.pieces[static_cast<std::size_t>(piece)].seen_px);
    return places;
}

std::size_t CellLights::averagePieces(CellShades& shades) const {
    std::vector<LitPiece> lit;
    std::vector<std::uint32_t> of;
    for (const EdgeCell& cell : cells_) {
        if (!rows_.inside(cell.pixel)) continue;
        for (std::size_t k = 0; k < cell.pieces.size(); ++k) {
            const CellPiece& piece = cell.pieces[k];
            if (!(piece.weight > 0.0 && piece.weight < 1.0) || piece.shade == kNoGroup) continue;
            if (!seesOther(shades, cell.pixel, piece.shade, piece)) continue;
            lit.push_back({cell.sign, shades.hits[piece.shade], placesOf(cell, static_cast<int>(k))});
            of.push_back(piece.shade);
        }
    }
    const std::vector<glm::dvec4> means = meansAt(grid_, device_, lit);
    for (std::size_t i = 0; i < of.size(); ++i) shades.colors[of[i]] = means[i];
    return of.size();
}

std::vector<std::size_t> CellLights::divideOthers(const CellShades& shades,
                                                  std::vector<glm::dvec4>& colors) const {
    const std::vector<std::size_t> order = rows_.zOrder(ConeRows::kMargin);
    std::vector<std::vector<std::size_t>> parts(partsOf(order));
    forParts(order, [&](std::size_t p, std::span<const std::size_t> pixels) {
        for (const std::size_t i : pixels) {
            const std::uint32_t own = shades.of_pixel[i];
            if (!divided(i) && own != kNoGroup && seesOther(shades, i, own, rows_.planes[i]))
                parts[p].push_back(i);
        }
    });
    std::vector<std::size_t> found;
    for (const std::vector<std::size_t>& part : parts) found.insert(found.end(), part.begin(), part.end());
    std::vector<LightCell> light_cells;
    for (const std::size_t i : found) {
        const std::uint32_t own = shades.of_pixel[i];
        light_cells.push_back({i, shades.hits[own], colors[i], shades.sights[own], otherColor(shades, i)});
    }
    const std::vector<glm::dvec4> means = meansOver(grid_, device_, rows_, light_cells);
    for (std::size_t k = 0; k < found.size(); ++k) colors[found[k]] = means[k];
    return found;
}

/// The mean of whole neighbours that see the one other sight there is; none where patterns colour the
/// surface.
std::optional<glm::dvec4> CellLights::otherColor(const CellShades& shades, std::size_t pixel) const {
    const std::uint32_t own = shades.of_pixel[pixel];
    const sdf::SurfaceMaterial& material = scene_.materials[shades.hits[own].material];
    if (shades.hits[own].color || material.pattern != sdf::SurfaceMaterial::Pattern::kNone)
        return std::nullopt;
    glm::dvec4 sum(0.0);
    double count = 0.0;
    std::optional<std::uint32_t> other;
    for (const std::size_t j : rows_.around(pixel)) {
        const std::uint32_t shade = shades.of_pixel[j];
        if (divided(j) || shade == kNoGroup || shades.sights[shade] == shades.sights[own]) continue;
        if (!smoothlyOne(rows_.planes[pixel], rows_.planes[j], rows_.radii[j])) continue;
        if (other && *other != shades.sights[shade]) return std::nullopt;
        other = shades.sights[shade], sum += shades.colors[shade], ++count;
    }
    return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace edgewise
