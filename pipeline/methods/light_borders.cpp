#include "pipeline/methods/light_borders.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <map>
#include <span>

#include "sdf/film_line.h"

namespace edgewise {
namespace {

/// Halvings of a side: the crossing is known to 1/16 px.
constexpr int kHalvings = 3;

struct Seen {
    glm::dvec4 color{0.0};
    std::uint32_t sight = 0;
};

/// A place of the film, on the tangent plane of a hit.
struct Place {
    const sdf::SurfaceHit* hit;
    double sign;
    glm::dvec2 at_px;
};

/// Around a pixel, one after the other; side k leads from corner k to the next.
const std::array<glm::dvec2, 4> kCorners{glm::dvec2(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

/// A side of pixels that the border crosses.
struct Side {
    std::size_t owner;          ///< the pixel on whose plane it lies
    glm::dvec2 from_px, to_px;  ///< upper or left one first
    std::uint32_t from_sight;   ///< what that end sees, and the other does not
    glm::dvec2 middle() const { return 0.5 * (from_px + to_px); }
};

struct Border {
    std::size_t cell;
    std::array<std::size_t, 2> sides{};
    glm::dvec2 other_px{0.0};  ///< beyond it
    glm::dvec2 same_px{0.0};
};

/// The hit moved along its tangent plane, no farther than a pixel's width times what its slope makes of
/// it.
sdf::SurfaceHit onPlane(sdf::SurfaceHit hit, const sdf::FieldRay& ray) {
    const double t = glm::dot(hit.p_world - ray.origin_world, hit.normal_world) /
                     glm::dot(ray.direction_world, hit.normal_world);
    if (!(t > 0.0) || !(t < ray.t_max)) return hit;
    const glm::dvec3 p = ray.origin_world + ray.direction_world * t;
    hit.p_local += p - hit.p_world;
    hit.p_world = p, hit.t = t;
    return hit;
}

class LightBorders {
  public:
    LightBorders(const sdf::RayGrid& grid, FieldTracer& tracer, const ConeRows& rows,
                 const std::vector<LightCell>& cells)
        : grid_(grid), tracer_(tracer), rows_(rows), cells_(cells) {
        for (const LightCell& cell : cells) means_.push_back(cell.color);
    }

    std::vector<glm::dvec4> means() {
        askCorners();
        for (int k = 0; k < kHalvings; ++k) halve();
        const std::vector<glm::dvec4> others = otherColors();
        for (std::size_t i = 0; i < borders_.size(); ++i) divide(borders_[i], others[i]);
        count();
        return std::move(means_);
    }

  private:
    std::vector<Seen> ask(const std::vector<Place>& places) {
        std::vector<sdf::TravellingRay> rays(places.size());
        std::vector<sdf::SurfaceHit> hits(places.size());
        tbb::parallel_for(std::size_t(0), places.size(), [&](std::size_t i) {
            rays[i] = {grid_.ray(places[i].at_px), places[i].sign};
            hits[i] = onPlane(*places[i].hit, rays[i].ray);
        });
        std::vector<std::uint32_t> sights;
        const std::vector<glm::dvec4> colors = tracer_.shade(rays, hits, &sights);
        std::vector<Seen> seen(places.size());
        for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = {colors[i], sights[i]};
        return seen;
    }
    Place ownPlace(std::size_t cell, const glm::dvec2& at_px) const {
        return {&cells_[cell].hit, rows_.cones.rays[cells_[cell].pixel].sign, at_px};
    }
    Place placeOf(std::size_t pixel, const glm::dvec2& at_px) const {
        return {rows_.hitOf(pixel), rows_.cones.rays[pixel].sign, at_px};
    }
    glm::dvec2 cornerOf(std::size_t pixel, std::size_t k) const {
        return rows_.centreOf(pixel) + kCorners[k % 4];
    }
    std::size_t latticeOf(std::size_t pixel, std::size_t k) const {
        const std::size_t right = k % 4 == 1 || k % 4 == 2, below = k % 4 >= 2;
        return (pixel / rows_.width() + below) * (rows_.width() + 1) + pixel % rows_.width() + right;
    }

    /// The first of some pixels, the upper left one first, that goes on from the pixel smoothly.
    std::size_t ownerOf(std::size_t pixel, std::initializer_list<std::size_t> around) const {
        for (const std::size_t j : around)
            if (j == pixel ||
                (rows_.hitOf(j) && smoothlyOne(rows_.planes[pixel], rows_.planes[j], rows_.radii[j])))
                return j;
        return pixel;
    }
    std::size_t ownerOfCorner(std::size_t pixel, std::size_t k) const {
        const std::size_t w = rows_.width(), right = k == 1 || k == 2, below = k >= 2;
        const std::size_t last = pixel + right + (below ? w : 0);
        return ownerOf(pixel, {last - w - 1, last - w, last - 1, last});
    }
    std::size_t ownerOfSide(std::size_t pixel, std::size_t k) const {
        const std::size_t w = rows_.width();
        const std::size_t before[] = {pixel - w, pixel, pixel, pixel - 1};
        return ownerOf(pixel, {before[k]});
    }

    void askCorners() {
        std::map<std::array<std::size_t, 2>, std::size_t> known;
        std::vector<Place> places;
        std::vector<std::array<std::size_t, 4>> corners(cells_.size());
        for (std::size_t i = 0; i < cells_.size(); ++i)
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t pixel = cells_[i].pixel, owner = ownerOfCorner(pixel, k);
                const auto [at, fresh] = known.try_emplace({latticeOf(pixel, k), owner}, places.size());
                if (fresh) places.push_back(placeOf(owner, cornerOf(pixel, k)));
                corners[i][k] = at->second;
            }
        const std::vector<Seen> seen = ask(places);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            std::array<std::uint32_t, 4> sights;
            for (std::size_t k = 0; k < 4; ++k) sights[k] = seen[corners[i][k]].sight;
            sort(i, sights);
        }
    }

    /// Corners that all see what the centre sees are done with; two kinds and two crossings make a border.
    void sort(std::size_t i, const std::array<std::uint32_t, 4>& sights) {
        Border border{i};
        std::size_t others = 0, crossings = 0, crossed[4] = {};
        std::optional<std::uint32_t> other;
        bool clear = true;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool differs = sights[k] != cells_[i].sight;
            if (differs) {
                clear = clear && (!other || sights[k] == *other);
                other = sights[k], ++others;
            }
            (differs ? border.other_px : border.same_px) += cornerOf(cells_[i].pixel, k);
            if (differs != (sights[(k + 1) % 4] != cells_[i].sight)) crossed[crossings++] = k;
        }
        if (others == 0) return;
        if (!clear || crossings != 2) {
            unclear_.push_back(i);
            return;
        }
        border.other_px /= static_cast<double>(others), border.same_px /= static_cast<double>(4 - others);
        for (std::size_t s = 0; s < 2; ++s) border.sides[s] = sideOf(cells_[i].pixel, crossed[s], sights);
        borders_.push_back(border);
    }

    std::size_t sideOf(std::size_t pixel, std::size_t k, const std::array<std::uint32_t, 4>& sights) {
        const bool turned = k >= 2;
        const std::size_t first = turned ? (k + 1) % 4 : k, last = turned ? k : k + 1;
        const std::size_t owner = ownerOfSide(pixel, k);
        const auto [at, fresh] = known_sides_.try_emplace(
            {2 * latticeOf(pixel, first) + k % 2, owner, sights[first]}, sides_.size());
        if (fresh) sides_.push_back({owner, cornerOf(pixel, first), cornerOf(pixel, last), sights[first]});
        return at->second;
    }

    void halve() {
        std::vector<Place> places;
        for (const Side& side : sides_) places.push_back(placeOf(side.owner, side.middle()));
        const std::vector<Seen> seen = ask(places);
        for (std::size_t i = 0; i < seen.size(); ++i)
            (seen[i].sight == sides_[i].from_sight ? sides_[i].from_px : sides_[i].to_px) =
                sides_[i].middle();
    }

    std::vector<glm::dvec4> otherColors() {
        std::vector<Place> places;
        for (const Border& border : borders_)
            if (!cells_[border.cell].other_color) places.push_back(ownPlace(border.cell, border.other_px));
        const std::vector<Seen> seen = ask(places);
        const Seen* next = seen.data();
        std::vector<glm::dvec4> colors;
        for (const Border& border : borders_) {
            const std::optional<glm::dvec4>& known = cells_[border.cell].other_color;
            colors.push_back(known ? *known : next++->color);
        }
        return colors;
    }

    void divide(const Border& border, const glm::dvec4& other_color) {
        const glm::dvec2 a = sides_[border.sides[0]].middle(), b = sides_[border.sides[1]].middle();
        const glm::dvec2 along = b - a, centre = rows_.centreOf(cells_[border.cell].pixel);
        const double size = glm::length(along);
        if (!(size > 0.0)) return;
        sdf::FilmLine line{-along.y / size, along.x / size, 0.0};
        line.c = -(line.a * a.x + line.b * a.y);
        if (line.at(border.same_px) > line.at(border.other_px)) line = line.reversed();
        const double same = sdf::areaOf(sdf::squareWithin(centre, {&line, 1}));
        means_[border.cell] = same * cells_[border.cell].color + (1.0 - same) * other_color;
    }

    void count() {
        std::vector<Place> places;
        for (const std::size_t i : unclear_)
            for (int k = 0; k < EdgeCell::kStandard; ++k)
                places.push_back(ownPlace(i, countedPlace(rows_.centreOf(cells_[i].pixel), k)));
        const std::vector<Seen> seen = ask(places);
        for (const std::size_t i : unclear_) means_[i] = glm::dvec4(0.0);
        for (std::size_t i = 0; i < seen.size(); ++i)
            means_[unclear_[i / EdgeCell::kStandard]] += seen[i].color / double(EdgeCell::kStandard);
    }

    const sdf::RayGrid& grid_;
    FieldTracer& tracer_;
    const ConeRows& rows_;
    const std::vector<LightCell>& cells_;
    std::vector<glm::dvec4> means_;
    std::map<std::array<std::size_t, 3>, std::size_t> known_sides_;
    std::vector<Side> sides_;
    std::vector<Border> borders_;
    std::vector<std::size_t> unclear_;
};

}  // namespace

std::vector<glm::dvec4> meansOver(const sdf::RayGrid& grid, FieldTracer& tracer, const ConeRows& rows,
                                  const std::vector<LightCell>& cells) {
    if (cells.empty()) return {};
    return LightBorders(grid, tracer, rows, cells).means();
}

std::vector<glm::dvec4> meansAt(const sdf::RayGrid& grid, FieldTracer& tracer,
                                std::span<const LitPiece> pieces) {
    std::vector<sdf::TravellingRay> rays;
    std::vector<sdf::SurfaceHit> hits;
    for (const LitPiece& piece : pieces)
        for (const glm::dvec2& place : piece.places_px) {
            rays.push_back({grid.ray(place), piece.sign});
            hits.push_back(onPlane(piece.hit, rays.back().ray));
        }
    if (rays.empty()) return {};
    const std::vector<glm::dvec4> colors = tracer.shade(rays, hits);
    std::vector<glm::dvec4> means;
    const glm::dvec4* color = colors.data();
    for (const LitPiece& piece : pieces) {
        glm::dvec4 sum(0.0);
        for (std::size_t k = 0; k < piece.places_px.size(); ++k) sum += *color++;
        means.push_back(sum / static_cast<double>(piece.places_px.size()));
    }
    return means;
}

}  // namespace edgewise
