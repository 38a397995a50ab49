#include "pipeline/methods/light_borders.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "pipeline/methods/edge_cell.h"
#include "sdf/film_line.h"

namespace edgewise {
namespace {

/// Halvings of a side: the crossing is known to 1/16 px.
constexpr int kHalvings = 3;

struct Seen {
    glm::dvec4 color{0.0};
    std::uint32_t sight = 0;
};

struct Crossing {
    glm::dvec2 same_px, other_px;  ///< ends of a side that see what the centre sees, and not
};

struct Border {
    std::size_t cell;
    glm::dvec4 other_color{0.0};
    std::uint32_t other_sight = 0;
    std::array<Crossing, 2> crossings;
};

const std::array<glm::dvec2, 4> kCorners{glm::dvec2(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

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
    LightBorders(const sdf::RayGrid& grid, FieldTracer& tracer, const std::vector<LightCell>& cells)
        : grid_(grid), tracer_(tracer), cells_(cells) {
        for (const LightCell& cell : cells) means_.push_back(cell.color);
    }

    std::vector<glm::dvec4> means() {
        std::vector<std::pair<std::size_t, glm::dvec2>> places;
        for (std::size_t i = 0; i < cells_.size(); ++i)
            for (const glm::dvec2& corner : kCorners) places.emplace_back(i, cells_[i].centre_px + corner);
        const std::vector<Seen> corners = ask(places);
        for (std::size_t i = 0; i < cells_.size(); ++i) sort(i, {corners.data() + 4 * i, 4});
        for (int k = 0; k < kHalvings; ++k) halve();
        for (const Border& border : borders_) divide(border);
        count();
        return std::move(means_);
    }

  private:
    std::vector<Seen> ask(const std::vector<std::pair<std::size_t, glm::dvec2>>& places) {
        std::vector<sdf::TravellingRay> rays(places.size());
        std::vector<sdf::SurfaceHit> hits(places.size());
        tbb::parallel_for(std::size_t(0), places.size(), [&](std::size_t i) {
            const LightCell& cell = cells_[places[i].first];
            rays[i] = {grid_.ray(places[i].second), cell.sign};
            hits[i] = onPlane(cell.hit, rays[i].ray);
        });
        std::vector<std::uint32_t> sights;
        const std::vector<glm::dvec4> colors = tracer_.shade(rays, std::move(hits), &sights);
        std::vector<Seen> seen(places.size());
        for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = {colors[i], sights[i]};
        return seen;
    }

    /// Corners that all see what the centre sees are done with; two kinds and two crossings make a border.
    void sort(std::size_t i, std::span<const Seen> corners) {
        const std::uint32_t same = cells_[i].sight;
        Border border{i, glm::dvec4(0.0), 0, {}};
        int others = 0, crossings = 0;
        bool clear = true;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t next = (k + 1) % 4;
            const bool differs = corners[k].sight != same, next_differs = corners[next].sight != same;
            if (differs) {
                clear = clear && (others == 0 || corners[k].sight == border.other_sight);
                border.other_sight = corners[k].sight, border.other_color += corners[k].color, ++others;
            }
            if (differs == next_differs) continue;
            const glm::dvec2 a = cells_[i].centre_px + kCorners[k], b = cells_[i].centre_px + kCorners[next];
            if (crossings < 2) border.crossings[crossings] = differs ? Crossing{b, a} : Crossing{a, b};
            ++crossings;
        }
        if (others == 0) return;
        border.other_color /= others;
        if (clear && crossings == 2)
            borders_.push_back(border);
        else
            unclear_.push_back(i);
    }

    void halve() {
        std::vector<std::pair<std::size_t, glm::dvec2>> places;
        for (const Border& border : borders_)
            for (const Crossing& c : border.crossings) places.emplace_back(border.cell, middleOf(c));
        const std::vector<Seen> seen = ask(places);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            Border& border = borders_[i / 2];
            Crossing& c = border.crossings[i % 2];
            (seen[i].sight == cells_[border.cell].sight ? c.same_px : c.other_px) = middleOf(c);
        }
    }
    static glm::dvec2 middleOf(const Crossing& c) { return 0.5 * (c.same_px + c.other_px); }

    void divide(const Border& border) {
        const glm::dvec2 a = middleOf(border.crossings[0]), b = middleOf(border.crossings[1]);
        const glm::dvec2 along = b - a, centre = cells_[border.cell].centre_px;
        const double size = glm::length(along);
        if (!(size > 0.0)) return;
        sdf::FilmLine line{-along.y / size, along.x / size, 0.0};
        line.c = -(line.a * a.x + line.b * a.y);
        if (line.at(border.crossings[0].same_px) > line.at(border.crossings[0].other_px))
            line = line.reversed();
        const double same = sdf::areaOf(sdf::squareWithin(centre, {&line, 1}));
        means_[border.cell] = same * cells_[border.cell].color + (1.0 - same) * border.other_color;
    }

    void count() {
        std::vector<std::pair<std::size_t, glm::dvec2>> places;
        for (const std::size_t i : unclear_)
            for (int k = 0; k < 16; ++k) places.emplace_back(i, countedPlace(cells_[i].centre_px, k));
        const std::vector<Seen> seen = ask(places);
        for (const std::size_t i : unclear_) means_[i] = glm::dvec4(0.0);
        for (std::size_t i = 0; i < seen.size(); ++i) means_[unclear_[i / 16]] += seen[i].color / 16.0;
    }

    const sdf::RayGrid& grid_;
    FieldTracer& tracer_;
    const std::vector<LightCell>& cells_;
    std::vector<glm::dvec4> means_;
    std::vector<Border> borders_;
    std::vector<std::size_t> unclear_;
};

}  // namespace

std::vector<glm::dvec4> meansOver(const sdf::RayGrid& grid, FieldTracer& tracer,
                                  const std::vector<LightCell>& cells) {
    if (cells.empty()) return {};
    return LightBorders(grid, tracer, cells).means();
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
    const std::vector<glm::dvec4> colors = tracer.shade(rays, std::move(hits));
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
