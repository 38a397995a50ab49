// SDF scenes on the CPU: tiles of rays on all threads, then each hit is shaded.
#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "pipeline/field_plan.h"
#include "pipeline/field_rays.h"
#include "pipeline/field_shading.h"
#include "pipeline/field_tracer.h"
#include "pipeline/methods/stopwatch.h"
#include "sdf/scene_trace.h"
#include "sdf/shader.h"
#include "sdf/tile_trace.h"

namespace edgewise {
namespace {

int tileOf(int px, int side) {
    return static_cast<int>(std::floor(static_cast<double>(px) / side));
}

/// Tells what a ray has seen.
class SightTracer : public sdf::SurfaceTracer {
  public:
    explicit SightTracer(const sdf::SurfaceTracer& of) : of_(of) {}
    sdf::SurfaceHit nearest(const sdf::FieldRay& ray, double sign) const override {
        const sdf::SurfaceHit hit = of_.nearest(ray, sign);
        sight_ = sightWith(sight_, hit.hit ? hit.material + 1 : 0);
        return hit;
    }
    bool occluded(const sdf::FieldRay& ray, double sign, std::uint64_t& evaluations) const override {
        const bool hidden = of_.occluded(ray, sign, evaluations);
        sight_ = sightWith(sight_, hidden);
        return hidden;
    }
    std::uint32_t takeSight() const { return std::exchange(sight_, 0u); }

  private:
    const sdf::SurfaceTracer& of_;
    mutable std::uint32_t sight_ = 0;
};

/// A tile's samples, and their groups one after the other.
struct TileCones {
    std::vector<std::uint32_t> samples, counts, evaluations;
    std::vector<sdf::ConeGroup> groups;
};

class CpuFieldTracer : public FieldTracer, private RayBatches {
  public:
    CpuFieldTracer(const MethodInput& in, const FieldSettings& settings)
        : in_(in),
          settings_(trustedSettings(*in.scene.field, settings.trace)),
          scene_(*in.scene.field),
          tape_(loweredTree(requireTree("tracing", in.scene))),
          grid_(rayGrid(in.camera, in.film, scene_.far)),
          cones_(settings.cones.value_or(sdf::ConeSettings{})),
          tracer_(scene_, tape_, settings_),
          shader_(fieldShading(in, settings_, false), tracer_) {
        sign_ = signOfView(tracer_, grid_, in.film);
        setup_seconds_ = watch_.lap();
    }

    FieldSamples trace(const FieldWindow& window) override {
        FieldSamples out = FieldSamples::sized(window.samples());
        std::vector<sdf::TraceHit> hits(window.samples());
        watch_.lap();
        if (tape_.size() > 0) traceTiles(window, hits);
        checkCancelled(in_.progress);
        watch_.book("trace", stages_);
        shadeAll(window, hits, out);
        checkCancelled(in_.progress);
        watch_.book("shade", stages_);
        return out;
    }

    FieldCones traceCones(const FieldWindow& window) override {
        watch_.lap();
        std::vector<TileCones> tiles = coneTiles(window);
        checkCancelled(in_.progress);
        FieldCones out = joined(window, tiles);
        if (cones_.shade_at_once) out.colors.resize(out.groups.size());
        tbb::enumerable_thread_specific<sdf::RayCounts> counts;
        tbb::parallel_for(std::size_t(0), tiles.size(),
                          [&](std::size_t i) { describe(tiles[i], out, counts.local()); });
        for (const sdf::RayCounts& part : counts) ray_counts_ += part;
        watch_.book("trace", stages_);
        return out;
    }

    std::vector<glm::dvec4> shade(std::span<const sdf::TravellingRay> rays,
                                  std::span<const sdf::SurfaceHit> hits,
                                  std::vector<std::uint32_t>* sights) override {
        watch_.lap();
        std::vector<glm::dvec4> colors(rays.size());
        if (sights) sights->resize(rays.size());
        tbb::enumerable_thread_specific<sdf::RayCounts> counts;
        eachPart(rays.size(), 1024, [&](std::size_t first, std::size_t last) {
            const SightTracer seeing(tracer_);
            const sdf::Shader shader(shader_.settings(), seeing);
            for (std::size_t i = first; i < last; ++i) {
                colors[i] = shader.shade(rays[i].ray, hits[i], counts.local(), rays[i].sign);
                if (sights) (*sights)[i] = sightWith(seeing.takeSight(), hits[i].material);
            }
        });
        for (const sdf::RayCounts& part : counts) ray_counts_ += part;
        watch_.book("shade", stages_);
        return colors;
    }

    RayBatches& batches() override { return *this; }

    void report(MethodResult& result) const override {
        for (const StageTime& stage : stages_) result.stages.push_back(stage);
        result.setup_seconds += setup_seconds_;
        result.device = "cpu";
        reportCounts(result);
        reportPlan(result);
    }

  private:
    /// Calls work(first, last) for parts of so many on all threads.
    template <class Work>
    void eachPart(std::size_t count, std::size_t at_once, const Work& work) {
        tbb::parallel_for(std::size_t(0), (count + at_once - 1) / at_once, [&](std::size_t part) {
            if (!in_.progress.cancelled()) work(part * at_once, std::min(count, (part + 1) * at_once));
        });
        checkCancelled(in_.progress);
    }

    std::vector<sdf::SurfaceHit> nearest(std::span<const sdf::TravellingRay> rays) override {
        std::vector<sdf::SurfaceHit> hits(rays.size());
        eachPart(rays.size(), 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) hits[i] = tracer_.nearest(rays[i].ray, rays[i].sign);
        });
        return hits;
    }
    std::vector<sdf::SurfaceHit> describe(std::span<const sdf::TravellingRay> rays,
                                          std::span<const double> depths) override {
        std::vector<sdf::SurfaceHit> hits(rays.size());
        eachPart(rays.size(), 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                sdf::TraceHit hit;
                hit.t = depths[i], hit.value = NAN;
                if (std::isfinite(hit.t)) hit.end = sdf::TraceEnd::kSurface;
                hits[i] = tracer_.fieldHit(rays[i].ray, hit, rays[i].sign);
            }
        });
        return hits;
    }
    std::vector<char> occluded(std::span<const sdf::TravellingRay> rays) override {
        std::vector<char> hidden(rays.size());
        eachPart(rays.size(), 64, [&](std::size_t first, std::size_t last) {
            std::uint64_t evaluations = 0;
            for (std::size_t i = first; i < last; ++i)
                hidden[i] = tracer_.occluded(rays[i].ray, rays[i].sign, evaluations);
        });
        return hidden;
    }
    std::vector<double> depths(std::span<const sdf::TravellingRay> rays) override {
        std::vector<double> depths(rays.size(), HUGE_VAL);
        if (tape_.size() == 0) return depths;
        const sdf::TileTracer loose(tape_, grid_, settings_, sign_, {}, &tracer_.cells());
        tbb::enumerable_thread_specific<sdf::TileCounts> counts;
        eachPart(rays.size(), 1024, [&](std::size_t first, std::size_t last) {
            std::vector<sdf::FieldRay> part;
            for (std::size_t i = first; i < last; ++i) part.push_back(limited(rays[i].ray));
            std::vector<sdf::TraceHit> hits(part.size());
            loose.traceLoose(part, hits, counts.local());
            for (std::size_t i = first; i < last; ++i)
                if (hits[i - first].hit()) depths[i] = hits[i - first].t;
        });
        for (const sdf::TileCounts& part : counts) counts_ += part;
        return depths;
    }

    static glm::dvec2 positionOf(const FieldWindow& window, std::size_t row, std::size_t column) {
        if (!window.positions_px.empty()) return window.positions_px[row * window.stride() + column];
        const std::size_t k = window.per_side;
        const auto place = [k](int first, std::size_t i) {
            return first + static_cast<int>(i / k) +
                   (static_cast<double>(i % k) + 0.5) / static_cast<double>(k);
        };
        return {place(window.pixels.x0, column), place(window.pixels.y0, row)};
    }

    /// What may be asked of tiles: positions elsewhere than in their pixels are in no tile's beam.
    sdf::TraceSettings tileSettings(const FieldWindow& window) const {
        sdf::TraceSettings settings = settings_;
        const int width = window.pixels.width();
        for (std::size_t i = 0; i < window.positions_px.size(); ++i) {
            const glm::dvec2 pixel(window.pixels.x0 + static_cast<int>(i % width),
                                   window.pixels.y0 + static_cast<int>(i / width));
            const glm::dvec2 within = window.positions_px[i] - pixel;
            if (std::min(within.x, within.y) >= 0.0 && std::max(within.x, within.y) < 1.0) continue;
            settings.prepass = false;
        }
        return settings;
    }

    /// The top tiles that a window meets, by rows.
    struct TileGrid {
        int side, x0, y0;
        std::size_t across, count;
        TileGrid(const PixelBox& box, int tile_side)
            : side(tile_side), x0(tileOf(box.x0, side)), y0(tileOf(box.y0, side)) {
            across = static_cast<std::size_t>(tileOf(box.x1 - 1, side) + 1 - x0);
            count = across * static_cast<std::size_t>(tileOf(box.y1 - 1, side) + 1 - y0);
        }
        PixelBox tile(std::size_t i) const {
            const int x = (x0 + static_cast<int>(i % across)) * side;
            const int y = (y0 + static_cast<int>(i / across)) * side;
            return {x, y, x + side, y + side};
        }
    };
    /// Calls work(tile's number, tile, tracer, counts) on all threads.
    template <class Work>
    void eachTile(const FieldWindow& window, const Work& work) {
        const sdf::TraceSettings settings = tileSettings(window);
        const sdf::TileSides sides = sdf::TileSides::forSamples(window.per_side);
        const sdf::TileTracer tiles(tape_, grid_, settings, sign_, sides, &tracer_.cells());
        const TileGrid grid(window.pixels, sides.top_px);
        tbb::enumerable_thread_specific<sdf::TileCounts> counts;
        tbb::parallel_for(std::size_t(0), grid.count, [&](std::size_t i) {
            if (!in_.progress.cancelled()) work(i, grid.tile(i), tiles, counts.local());
        });
        for (const sdf::TileCounts& part : counts) counts_ += part;
    }

    void traceTiles(const FieldWindow& window, std::vector<sdf::TraceHit>& hits) {
        eachTile(window, [&](std::size_t, const PixelBox& tile, const sdf::TileTracer& tiles,
                             sdf::TileCounts& counts) {
            std::vector<sdf::TileRay> rays = raysOf(window, tile);
            tiles.trace(tile.x0, tile.y0, rays, hits, counts);
        });
    }

    std::vector<TileCones> coneTiles(const FieldWindow& window) {
        const int side = sdf::TileSides::forSamples(window.per_side).top_px;
        std::vector<TileCones> out(TileGrid(window.pixels, side).count);
        if (tape_.size() == 0) return out;
        eachTile(window, [&](std::size_t i, const PixelBox& tile, const sdf::TileTracer& tiles,
                             sdf::TileCounts& counts) {
            std::vector<sdf::TileRay> rays = raysOf(window, tile);
            for (std::size_t k = 0; k < rays.size(); ++k) {
                out[i].samples.push_back(rays[k].index);
                rays[k].index = static_cast<std::uint32_t>(k);
            }
            std::vector<sdf::ConeHits> hits(rays.size());
            tiles.traceCones(tile.x0, tile.y0, rays, cones_, hits, counts);
            for (const sdf::ConeHits& met : hits) {
                out[i].counts.push_back(static_cast<std::uint32_t>(met.count));
                out[i].evaluations.push_back(met.evaluations);
                out[i].groups.insert(out[i].groups.end(), met.groups.begin(), met.groups.begin() + met.count);
            }
        });
        return out;
    }

    /// All but the groups and their surfaces.
    FieldCones joined(const FieldWindow& window, const std::vector<TileCones>& tiles) const {
        FieldCones out;
        const std::size_t count = window.samples(), stride = window.stride();
        out.rays.resize(count), out.evaluations.resize(count), out.begin.resize(count + 1);
        tbb::parallel_for(std::size_t(0), count / stride, [&](std::size_t row) {
            for (std::size_t column = 0; column < stride; ++column)
                out.rays[row * stride + column] = {grid_.ray(positionOf(window, row, column)), sign_};
        });
        for (const TileCones& tile : tiles)
            for (std::size_t k = 0; k < tile.samples.size(); ++k) {
                out.begin[tile.samples[k] + 1] = tile.counts[k];
                out.evaluations[tile.samples[k]] = tile.evaluations[k];
            }
        std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
        out.groups.resize(out.begin.back()), out.surfaces.resize(out.begin.back());
        return out;
    }

    void describe(const TileCones& tile, FieldCones& out, sdf::RayCounts& counts) const {
        const sdf::ConeGroup* group = tile.groups.data();
        for (std::size_t k = 0; k < tile.samples.size(); ++k) {
            const std::uint32_t sample = tile.samples[k];
            for (std::uint32_t i = out.begin[sample]; i < out.begin[sample + 1]; ++i, ++group) {
                out.groups[i] = *group;
                if (cones_.hard_only && !group->hard) continue;
                const sdf::TraceHit hit{sdf::TraceEnd::kSurface, group->t, NAN,
                                        out.evaluations[sample], 0,        0};
                out.surfaces[i] = tracer_.fieldHit(out.rays[sample].ray, hit, sign_);
                if (!out.colors.empty())
                    out.colors[i] = shader_.shade(out.rays[sample].ray, out.surfaces[i], counts, sign_);
            }
        }
    }

    /// Of a tile's pixels within the window. Rays end where a closed form's surface is, and where the convex
    /// bound does.
    std::vector<sdf::TileRay> raysOf(const FieldWindow& window, const PixelBox& tile) const {
        const PixelBox& box = window.pixels;
        const int k = window.per_side;
        const int x0 = (std::max(tile.x0, box.x0) - box.x0) * k,
                  x1 = (std::min(tile.x1, box.x1) - box.x0) * k;
        const int y0 = (std::max(tile.y0, box.y0) - box.y0) * k,
                  y1 = (std::min(tile.y1, box.y1) - box.y0) * k;
        std::vector<sdf::TileRay> rays;
        rays.reserve(static_cast<std::size_t>(x1 - x0) * (y1 - y0));
        for (int row = y0; row < y1; ++row)
            for (int column = x0; column < x1; ++column) {
                sdf::TileRay ray;
                ray.p_px = positionOf(window, row, column);
                ray.index = static_cast<std::uint32_t>(row * window.stride() + column);
                ray.ray = limited(grid_.ray(ray.p_px));
                if (ray.ray.t_min < ray.ray.t_max) rays.push_back(ray);
            }
        return rays;
    }

    sdf::FieldRay limited(sdf::FieldRay ray) const {
        sdf::SurfaceHit closed;
        tracer_.meetAnalytic(ray, closed);
        if (closed.hit) ray.t_max = closed.t;
        if (!tracer_.withinBound(ray)) ray.t_max = ray.t_min;
        return ray;
    }

    void shadeAll(const FieldWindow& window, const std::vector<sdf::TraceHit>& hits, FieldSamples& out) {
        tbb::enumerable_thread_specific<sdf::RayCounts> counts;
        const std::size_t stride = window.stride(), rows = window.samples() / stride;
        tbb::parallel_for(std::size_t(0), rows, [&](std::size_t row) {
            if (in_.progress.cancelled()) return;
            sdf::RayCounts& own = counts.local();
            for (std::size_t column = 0; column < stride; ++column) {
                const sdf::FieldRay ray = grid_.ray(positionOf(window, row, column));
                shadeOne(ray, hits[row * stride + column], own, row * stride + column, out);
            }
        });
        for (const sdf::RayCounts& part : counts) ray_counts_ += part;
    }

    void shadeOne(const sdf::FieldRay& ray, const sdf::TraceHit& hit, sdf::RayCounts& counts, std::size_t i,
                  FieldSamples& out) const {
        sdf::SurfaceHit seen = tracer_.fieldHit(ray, hit, sign_);
        tracer_.meetAnalytic(ray, seen);
        out.color[i] = shader_.shade(ray, seen, counts, sign_);
        out.evaluations[i] = hit.evaluations, out.iterations[i] = hit.iterations;
        out.take(i, ray, seen);
        if (seen.hit) out.residual[i] = static_cast<float>(seen.value);
    }

    void reportCounts(MethodResult& result) const {
        auto& counts = result.counts;
        counts["instructions_of_tape"] = tape_.size();
        counts["rays"] = counts_.rays, counts["evaluations"] = counts_.evaluations;
        counts["iterations"] = counts_.iterations, counts["failed_steps"] = counts_.failed;
        counts["cones"] = counts_.cones, counts["cone_evaluations"] = counts_.cone_evaluations;
        counts["instructions"] = counts_.instructions, counts["tape_passes"] = counts_.passes;
        counts["tiles"] = counts_.leaf_tiles + counts_.empty_tiles;
        counts["tiles_empty"] = counts_.empty_tiles;
        counts["pruned_tapes"] = counts_.prune.tapes;
        counts["prune_instructions"] = counts_.prune.instructions;
        counts["prune_microseconds"] = static_cast<std::uint64_t>(counts_.prune.seconds * 1e6);
        counts["secondary_tapes"] = tracer_.cells().counts().tapes - counts_.prune.tapes;
        counts["shadow_rays"] = ray_counts_.shadow, counts["reflection_rays"] = ray_counts_.reflection;
        counts["refraction_rays"] = ray_counts_.refraction;
        counts["secondary_evaluations"] = ray_counts_.evaluations;
    }

    void reportPlan(MethodResult& result) const {
        const sdf::TraceSettings& t = settings_;
        const bool field = tape_.size() > 0;
        result.plan.push_back({"prepass", t.prepass && field, prepassWords(field)});
        const bool prunes = t.prune && scene_.bound_holds && tape_.size() >= sdf::kShortTape;
        result.plan.push_back({"prune", prunes, pruneWords(field)});
        addClosedForms(scene_, settings_, result.plan);
    }
    std::string prepassWords(bool field) const {
        if (!field) return "the scene has no field";
        if (!scene_.bound_holds) return kBoundBroken;
        if (!settings_.prepass) return "switched off";
        return fmt::format("{} cones with {} evaluations; {} of {} tiles are empty", counts_.cones,
                           counts_.cone_evaluations, counts_.empty_tiles,
                           counts_.leaf_tiles + counts_.empty_tiles);
    }
    std::string pruneWords(bool field) const {
        if (!field) return "the scene has no field";
        if (!scene_.bound_holds) return kBoundBroken;
        if (!settings_.prune) return "switched off";
        if (tape_.size() < sdf::kShortTape)
            return fmt::format("{} instructions are too few to be worth it", tape_.size());
        const double asked = static_cast<double>(counts_.evaluations + counts_.cone_evaluations);
        return fmt::format("of {} instructions an evaluation runs {:.1f}; {} tapes were made", tape_.size(),
                           asked > 0.0 ? static_cast<double>(counts_.instructions) / asked : 0.0,
                           tracer_.cells().counts().tapes);
    }

    const MethodInput in_;
    const sdf::TraceSettings settings_;
    const sdf::FieldScene& scene_;
    Stopwatch watch_;
    const sdf::Tape tape_;
    const sdf::RayGrid grid_;
    const sdf::ConeSettings cones_;
    const sdf::SceneTracer tracer_;
    const sdf::Shader shader_;
    double sign_ = 1.0, setup_seconds_ = 0.0;
    std::vector<StageTime> stages_;
    sdf::TileCounts counts_;
    sdf::RayCounts ray_counts_;
};

}  // namespace

std::unique_ptr<FieldTracer> makeCpuFieldTracer(const MethodInput& input, const FieldSettings& settings) {
    return std::make_unique<CpuFieldTracer>(input, settings);
}

}  // namespace edgewise
