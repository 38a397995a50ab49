#include "pipeline/methods/cone_x.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/methods/cell_division.h"
#include "pipeline/methods/light_borders.h"
#include "pipeline/methods/over_device.h"
#include "pipeline/methods/pattern_footprint.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise {
namespace {

/// Rows whose cones are held at once, beside one above and one below.
constexpr int kRowsAtOnce = 128;
constexpr std::uint32_t kNoGroup = 0xffffffffu;

/// The cones of some rows and all around them.
struct ConeRows {
    PixelBox pixels;  ///< with a margin of one
    FieldCones cones;
    std::vector<std::uint32_t> hard;  ///< a pixel: the group that its ray meets, or kNoGroup
    std::vector<char> soft;           ///< a group lies before that

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
    double radiusOf(std::size_t pixel) const {
        const sdf::SurfaceHit* hit = hitOf(pixel);
        const sdf::FieldRay& ray = cones.rays[pixel].ray;
        return ray.pixel_radius + ray.pixel_slope * (hit ? hit->t : 0.0);
    }
    /// The eight neighbours of a pixel that is not in the margin.
    std::array<std::size_t, 8> around(std::size_t i) const {
        const std::size_t w = width();
        return {i - w - 1, i - w, i - w + 1, i - 1, i + 1, i + w - 1, i + w, i + w + 1};
    }
};

class ConeXTracer : public OverDevice {
  public:
    ConeXTracer(const MethodInput& in, const FieldSettings& settings, std::unique_ptr<FieldTracer> device)
        : OverDevice(std::move(device)),
          in_(in),
          scene_(*in.scene.field),
          grid_(rayGrid(in.camera, in.film, scene_.far)),
          background_(in.options.background, 0.0) {
        if (scene_.glsl || scene_.tree.empty()) return;
        tape_ = loweredTree(scene_);
        field_.emplace(scene_, tape_, sdf::trustedSettings(scene_, settings.trace));
    }

    FieldSamples trace(const FieldWindow& window) override {
        FieldSamples out = FieldSamples::sized(window.samples());
        out.mixed.resize(window.samples());
        for (int y = window.pixels.y0; y < window.pixels.y1;) {
            const int end = std::min((y / kRowsAtOnce + 1) * kRowsAtOnce, window.pixels.y1);
            traceRows(window, y, std::max(end, y + 1), out);
            y = std::max(end, y + 1);
        }
        return out;
    }
    void report(MethodResult& result) const override {
        device_->report(result);
        result.stages.insert(result.stages.end(), stages_.begin(), stages_.end());
        result.counts["pixels"] = pixels_, result.counts["pixels_doubtful"] = doubtful_;
        result.counts["pixels_complex"] = complex_, result.counts["pixels_counted"] = counted_;
        result.counts["pixels_of_light_borders"] = lights_;
        result.counts["edge_rays"] = edge_rays_;
    }

  private:
    void traceRows(const FieldWindow& window, int y0, int y1, FieldSamples& out) {
        const ConeRows rows = conesOf({window.pixels.x0 - 1, y0 - 1, window.pixels.x1 + 1, y1 + 1});
        watch_.lap();
        std::vector<EdgeCell> cells = doubtfulCells(rows);
        doubtful_ += cells.size();
        divide(cells);
        watch_.book("edges", stages_);
        Shades shades = shadeAll(rows, cells);
        watch_.lap();
        std::vector<glm::dvec4> colors = blended(rows, cells, shades);
        const std::vector<std::size_t> borders = mendLights(rows, cells, shades, colors);
        watch_.book("lights", stages_);
        keep(window, rows, cells, borders, colors, out);
        watch_.book("blend", stages_);
    }

    ConeRows conesOf(const PixelBox& pixels) {
        ConeRows rows;
        rows.pixels = pixels;
        FieldWindow window;
        window.pixels = pixels;
        rows.cones = device_->traceCones(window);
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

    /// Pixels, without the margin, that something but one smooth surface may lie in.
    std::vector<EdgeCell> doubtfulCells(const ConeRows& rows) const {
        const std::size_t height = static_cast<std::size_t>(rows.pixels.height()), width = rows.width();
        std::vector<std::vector<EdgeCell>> by_row(height);
        tbb::parallel_for(std::size_t(1), height - 1, [&](std::size_t y) {
            for (std::size_t x = 1; x + 1 < width; ++x)
                if (auto cell = doubtfulCell(rows, y * width + x)) by_row[y].push_back(std::move(*cell));
        });
        std::vector<EdgeCell> cells;
        for (std::vector<EdgeCell>& row : by_row)
            cells.insert(cells.end(), std::make_move_iterator(row.begin()),
                         std::make_move_iterator(row.end()));
        return cells;
    }

    std::optional<EdgeCell> doubtfulCell(const ConeRows& rows, std::size_t i) const {
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
        cell.t_start = first < rows.cones.begin[i + 1] ? rows.cones.groups[first].entry : grid_.t_max;
        if (rows.soft[i]) cell.soft_t = rows.cones.groups[first].entry;
        for (const CellPiece& other : others)
            if (std::ranges::none_of(cell.pieces,
                                     [&](const auto& p) { return smoothlyOne(p, other, rows.radiusOf(i)); }))
                cell.pieces.push_back(other);
        return cell;
    }

    void divide(std::vector<EdgeCell>& cells) {
        const CellDivision dividing(grid_, field_ ? &*field_ : nullptr);
        askSamples(dividing, cells, 1, 1 + EdgeCell::kCorners);
        eachUnresolved(cells, [&](EdgeCell& cell) { dividing.divide(cell, false); });
        askSamples(dividing, cells, 1 + EdgeCell::kCorners, EdgeCell::kMost);
        eachUnresolved(cells, [&](EdgeCell& cell) { dividing.divide(cell, true); });
        counted_ += static_cast<std::uint64_t>(
            std::ranges::count_if(cells, [](const EdgeCell& cell) { return cell.counted; }));
    }

    template <class Work>
    static void eachUnresolved(std::vector<EdgeCell>& cells, const Work& work) {
        tbb::parallel_for(std::size_t(0), cells.size(), [&](std::size_t i) {
            if (!cells[i].resolved) work(cells[i]);
        });
    }

    sdf::TravellingRay rayFrom(const EdgeCell& cell, const glm::dvec2& p_px) const {
        sdf::TravellingRay ray{grid_.ray(p_px), cell.sign};
        ray.ray.t_min = std::max(ray.ray.t_min, std::min(cell.t_start, ray.ray.t_max));
        return ray;
    }

    /// Of unresolved cells: where samples first to last meet what, and pieces for what is on none.
    void askSamples(const CellDivision& dividing, std::vector<EdgeCell>& cells, int first, int last) {
        std::vector<EdgeCell*> asked;
        for (EdgeCell& cell : cells)
            if (!cell.resolved) asked.push_back(&cell);
        const std::size_t each = static_cast<std::size_t>(last - first);
        std::vector<sdf::TravellingRay> rays(asked.size() * each);
        tbb::parallel_for(std::size_t(0), asked.size(), [&](std::size_t i) {
            for (int k = first; k < last; ++k)
                rays[i * each + static_cast<std::size_t>(k - first)] =
                    rayFrom(*asked[i], asked[i]->sampleAt(k));
        });
        const std::vector<double> depths = device_->batches().depths(rays);
        edge_rays_ += rays.size();
        for (std::size_t i = 0; i < asked.size(); ++i) {
            for (int k = first; k < last; ++k)
                asked[i]->depths[k] = depths[i * each + static_cast<std::size_t>(k - first)];
            asked[i]->samples = last;
        }
        while (!asked.empty()) nameSamples(dividing, asked);
    }

    /// One more piece for each cell that needs one; those are asked again.
    void nameSamples(const CellDivision& dividing, std::vector<EdgeCell*>& asked) {
        std::vector<int> stranger(asked.size(), EdgeCell::kUnknown);
        tbb::parallel_for(std::size_t(0), asked.size(), [&](std::size_t i) {
            EdgeCell& cell = *asked[i];
            for (int k = 1; k < cell.samples; ++k) {
                cell.labels[k] = dividing.labelOf(cell, k, cell.depths[k]);
                if (cell.labels[k] == EdgeCell::kUnknown) stranger[i] = k;
            }
        });
        std::vector<EdgeCell*> again;
        std::vector<sdf::TravellingRay> rays;
        std::vector<double> depths;
        std::vector<int> samples;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            const int k = stranger[i];
            if (k == EdgeCell::kUnknown) continue;
            again.push_back(asked[i]), samples.push_back(k);
            rays.push_back(rayFrom(*asked[i], asked[i]->sampleAt(k)));
            depths.push_back(asked[i]->depths[k]);
        }
        const std::vector<sdf::SurfaceHit> hits = device_->batches().describe(rays, depths);
        for (std::size_t i = 0; i < again.size(); ++i) {
            EdgeCell& cell = *again[i];
            CellPiece piece = pieceOf(hits[i].hit ? &hits[i] : nullptr, cell.sampleAt(samples[i]));
            if (hits[i].hit) piece.hit = hits[i];
            cell.depths[samples[i]] = hits[i].hit ? hits[i].t : HUGE_VAL;
            adopt(cell, piece);
        }
        asked = std::move(again);
    }

    /// A piece more; surfaces that it goes on from smoothly bend as it says.
    void adopt(EdgeCell& cell, CellPiece& piece) const {
        const double radius = piece.hit ? grid_.halfPixel() * (grid_.perspective ? piece.hit->t : 1.0) : 0.0;
        for (CellPiece& known : cell.pieces)
            if (!known.sky && smoothlyOne(known, piece, radius))
                takeBend(known, piece), takeBend(piece, known);
        cell.pieces.push_back(piece);
    }

    /// Everything that is shaded, and what came of it.
    struct Shades {
        std::vector<sdf::TravellingRay> rays;
        std::vector<sdf::SurfaceHit> hits;
        std::vector<std::uint32_t> of_pixel;  ///< its own hit's place; kNoGroup: none
        std::vector<glm::dvec4> colors;
        std::vector<std::uint32_t> sights;
    };

    Shades shadeAll(const ConeRows& rows, std::vector<EdgeCell>& cells) {
        meetPieces(cells);
        Shades shades;
        shades.of_pixel.assign(rows.cones.samples(), kNoGroup);
        std::vector<char> hidden(rows.cones.samples());
        for (const EdgeCell& cell : cells) hidden[cell.pixel] = cell.pieces.front().weight == 0.0;
        for (std::size_t i = 0; i < rows.cones.samples(); ++i) {
            const sdf::SurfaceHit* hit = rows.hitOf(i);
            if (!hit || hidden[i]) continue;
            shades.of_pixel[i] = static_cast<std::uint32_t>(shades.rays.size());
            shades.rays.push_back(rows.cones.rays[i]);
            shades.hits.push_back(*hit);
        }
        averagePatterns(rows, shades);
        for (const EdgeCell& cell : cells)
            for (std::size_t k = 1; k < cell.pieces.size(); ++k) {
                const CellPiece& piece = cell.pieces[k];
                if (piece.weight == 0.0 || piece.sky || !piece.hit) continue;
                shades.rays.push_back({grid_.ray(piece.seen_px), cell.sign});
                shades.hits.push_back(*piece.hit);
                takePattern(rows, cell.pixel, shades.hits.back());
            }
        shades.colors = device_->shade(shades.rays, shades.hits, &shades.sights);
        return shades;
    }

    /// Pieces that only neighbours have met are met within their pixel.
    void meetPieces(std::vector<EdgeCell>& cells) {
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
                rays.push_back(rayFrom(cell, piece.seen_px));
                depths.push_back(cell.depths[sample]);
                pieces.emplace_back(&cell, k);
            }
        const std::vector<sdf::SurfaceHit> hits = device_->batches().describe(rays, depths);
        for (std::size_t i = 0; i < pieces.size(); ++i)
            if (hits[i].hit) pieces[i].first->pieces[pieces[i].second].hit = hits[i];
    }

    /// The change of the place in the shape's frame from a pixel to the next, from neighbours on the same
    /// surface.
    std::optional<glm::dvec3> stepOf(const ConeRows& rows, std::size_t i, const sdf::SurfaceHit& hit,
                                     std::size_t before, std::size_t after) const {
        const CellPiece own = pieceOf(&hit, {});
        const auto local = [&](std::size_t j) -> std::optional<glm::dvec3> {
            const sdf::SurfaceHit* other = rows.hitOf(j);
            if (!other || !smoothlyOne(own, pieceOf(other, {}), rows.radiusOf(j))) return std::nullopt;
            return other->p_local;
        };
        const auto b = local(before), a = local(after), c = local(i);
        if (a && b) return 0.5 * (*a - *b);
        if (a && c) return *a - *c;
        if (b && c) return *c - *b;
        return std::nullopt;
    }

    void takePattern(const ConeRows& rows, std::size_t i, sdf::SurfaceHit& hit) const {
        const sdf::SurfaceMaterial& material = scene_.materials[hit.material];
        if (hit.color || material.pattern == sdf::SurfaceMaterial::Pattern::kNone) return;
        const std::size_t x = i % rows.width(), y = i / rows.width(),
                          height = static_cast<std::size_t>(rows.pixels.height());
        const auto right = stepOf(rows, i, hit, x > 0 ? i - 1 : i, x + 1 < rows.width() ? i + 1 : i);
        const auto down =
            stepOf(rows, i, hit, y > 0 ? i - rows.width() : i, y + 1 < height ? i + rows.width() : i);
        if (right && down) hit.color = patternOver(material, hit, *right, *down);
    }

    void averagePatterns(const ConeRows& rows, Shades& shades) const {
        tbb::parallel_for(std::size_t(0), rows.cones.samples(), [&](std::size_t i) {
            if (shades.of_pixel[i] != kNoGroup) takePattern(rows, i, shades.hits[shades.of_pixel[i]]);
        });
    }

    std::vector<glm::dvec4> blended(const ConeRows& rows, const std::vector<EdgeCell>& cells,
                                    const Shades& shades) const {
        std::vector<glm::dvec4> colors(rows.cones.samples(), background_);
        std::size_t next = 0;
        for (std::size_t i = 0; i < colors.size(); ++i)
            if (shades.of_pixel[i] != kNoGroup) colors[i] = shades.colors[shades.of_pixel[i]], ++next;
        for (const EdgeCell& cell : cells) {
            glm::dvec4 sum = cell.pieces.front().weight * colors[cell.pixel];
            for (std::size_t k = 1; k < cell.pieces.size(); ++k) {
                const CellPiece& piece = cell.pieces[k];
                if (piece.weight == 0.0) continue;
                sum += piece.weight * (piece.sky || !piece.hit ? background_ : shades.colors[next++]);
            }
            colors[cell.pixel] = sum;
        }
        return colors;
    }

    /// Pixels of one surface whose neighbours on it see other lights or reflections.
    std::vector<std::size_t> mendLights(const ConeRows& rows, const std::vector<EdgeCell>& cells,
                                        const Shades& shades, std::vector<glm::dvec4>& colors) {
        std::vector<char> divided(rows.cones.samples());
        for (const EdgeCell& cell : cells) divided[cell.pixel] = cell.pieces.front().weight < 1.0;
        std::vector<std::size_t> found;
        const std::size_t height = static_cast<std::size_t>(rows.pixels.height()), width = rows.width();
        for (std::size_t y = 1; y + 1 < height; ++y)
            for (std::size_t x = 1; x + 1 < width; ++x) {
                const std::size_t i = y * width + x;
                if (!divided[i] && seesOther(rows, shades, i)) found.push_back(i);
            }
        std::vector<LightCell> light_cells;
        for (const std::size_t i : found) {
            const std::uint32_t own = shades.of_pixel[i];
            light_cells.push_back(
                {rows.centreOf(i), rows.cones.rays[i].sign, shades.hits[own], colors[i], shades.sights[own]});
        }
        const std::vector<glm::dvec4> mended = meansOver(grid_, *device_, light_cells);
        for (std::size_t k = 0; k < found.size(); ++k) colors[found[k]] = mended[k];
        return found;
    }

    static bool seesOther(const ConeRows& rows, const Shades& shades, std::size_t i) {
        const std::uint32_t own = shades.of_pixel[i];
        if (own == kNoGroup) return false;
        const CellPiece piece = pieceOf(rows.hitOf(i), {});
        for (const std::size_t j : rows.around(i)) {
            const std::uint32_t other = shades.of_pixel[j];
            if (other == kNoGroup || shades.sights[other] == shades.sights[own]) continue;
            if (smoothlyOne(piece, pieceOf(rows.hitOf(j), {}), rows.radiusOf(i))) return true;
        }
        return false;
    }

    void keep(const FieldWindow& window, const ConeRows& rows, const std::vector<EdgeCell>& cells,
              const std::vector<std::size_t>& borders, const std::vector<glm::dvec4>& colors,
              FieldSamples& out) {
        const PixelBox& box = window.pixels;
        const auto to = [&](std::size_t i) {
            const std::size_t x = i % rows.width() - 1, y = i / rows.width() - 1;
            return (y + static_cast<std::size_t>(rows.pixels.y0 + 1 - box.y0)) * window.stride() + x;
        };
        for (std::size_t y = 1; y + 1 < static_cast<std::size_t>(rows.pixels.height()); ++y)
            for (std::size_t x = 1; x + 1 < rows.width(); ++x) {
                const std::size_t i = y * rows.width() + x, k = to(i);
                out.color[k] = colors[i];
                out.evaluations[k] = out.iterations[k] = rows.cones.evaluations[i];
                ++pixels_;
                if (const sdf::SurfaceHit* hit = rows.hitOf(i)) out.take(k, rows.cones.rays[i].ray, *hit);
            }
        for (const EdgeCell& cell : cells)
            if (cell.pieces.front().weight < 1.0) out.mixed[to(cell.pixel)] = 1, ++complex_;
        for (const std::size_t i : borders) out.mixed[to(i)] = 1;
        lights_ += borders.size();
    }

    const MethodInput in_;
    const sdf::FieldScene& scene_;
    const sdf::RayGrid grid_;
    const glm::dvec4 background_;
    sdf::Tape tape_;
    std::optional<sdf::SceneTracer> field_;
    Stopwatch watch_;
    std::vector<StageTime> stages_;
    std::uint64_t pixels_ = 0, doubtful_ = 0, complex_ = 0, counted_ = 0, lights_ = 0, edge_rays_ = 0;
};

}  // namespace

FieldTracerMaker coneXMaker(const FieldTracerMaker& make) {
    return [make](const MethodInput& in, const FieldSettings& settings) -> std::unique_ptr<FieldTracer> {
        return std::make_unique<ConeXTracer>(in, settings, make(in, settings));
    };
}

}  // namespace edgewise
