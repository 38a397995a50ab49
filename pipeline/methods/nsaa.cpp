// Non-sampled antialiasing (Auzinger et al. 2013): every pixel is the closed-form integral of the prefilter
// over the visible part of every triangle. project -> plan -> gather -> visibility -> weights -> shade and
// blend.
#include "pipeline/methods/nsaa.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>

#include "pipeline/bands.h"
#include "pipeline/blend.h"
#include "pipeline/composite.h"
#include "pipeline/dump_stages.h"
#include "pipeline/gather.h"
#include "pipeline/methods/aov_report.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/plan.h"

namespace edgewise {
namespace {

/// Supports end R from a sample; a pixel more keeps the window's own cuts out of every support.
double reachOf(const Prefilter& filter) {
    return filter.radius + 1.0;
}

Window windowOf(const PixelBox& box, glm::dvec2 offset_px, double reach) {
    return {static_cast<int>(std::floor(box.x0 + offset_px.x - reach)),
            static_cast<int>(std::floor(box.y0 + offset_px.y - reach)),
            static_cast<int>(std::ceil(box.x1 + offset_px.x + reach)),
            static_cast<int>(std::ceil(box.y1 + offset_px.y + reach))};
}

/// One thread's scratch, and the time that its two stages took.
struct TileWorker {
    WeightWorker weights;
    WeightTile tile, every_owner;
    std::vector<StageTime> times;
    std::uint64_t pairs = 0;
};

class Nsaa {
  public:
    explicit Nsaa(const MethodInput& in)
        : in_(in),
          screen_(project(in.scene, in.camera, in.film, pieces_, in.progress)),
          shading_(in.scene, in.camera, in.film, screen_, pieces_),
          aov_(in.options.aovs, in.scene, in.camera, in.film, screen_, pieces_, shading_),
          dump_(in.options.dump_dir, in.film.crop) {
        watch_.book("project", result_.stages);
        checkCancelled(in.progress);
        in.progress.stage("plan", 0);
        plan_ = makePlan(in.scene, screen_, pieces_, shading_, in.options);
        plan_.visibility.film_offset_px = offset();
        watch_.book("plan", result_.stages);
        dump_.screen(screen_);
        dump_.plan(plan_.entries);
    }

    MethodResult render() {
        const PixelBox& crop = in_.film.crop;
        result_.image = ImageBuffer(crop);
        aov_.begin(result_.image);
        Bands bands = cutIntoBands(crop);
        std::size_t band_count = 0;
        for (auto band = bands.next(); band; band = bands.next(), ++band_count) {
            const std::uint64_t before = visibility_counts_.pieces;
            renderBand(*band);
            bands.made(visibility_counts_.pieces - before);
        }
        aov_.samplePoints(in_.progress, result_.image);
        if (aov_.pointSamples()) watch_.book("aov", result_.stages);
        dump_.finish();
        result_.plan = plan_.entries;
        if (in_.options.shading.mode == ShadingMode::kHit)
            result_.notes.emplace_back("nsaa has no samples that hit: shaded at the closest point");
        fillCounts(band_count);
        return std::move(result_);
    }

    PixelReport report(int x, int y) {
        plan_.classes.representative.clear();
        const PixelBox box{x, y, x + 1, y + 1};
        cutIntoBands(box);  // throws where --memory does not suffice
        const VisibleMap map = visibleMapOf(box);
        TileWorker worker{WeightWorker(in_.filter, plan_.weights), {}, {}, {}};
        const WeightTiles tiles = gatherSegments(map, box, offset(), in_.filter.radius);
        const MapOwners owners(plan_.classes, map);
        worker.weights.run(map, tiles.segments.ids, owners.classes, box, offset(), worker.tile);
        PixelReport out;
        FixedWeight sum = 0;
        for (std::size_t e = 0; e < worker.tile.entries.size(); ++e) {
            const OwnerWeight& entry = worker.tile.entries[e];
            sum += entry.weight;
            reportOwner(owners.stacks.layersOf(entry.owner), entry.weight,
                        glm::dvec2(x + 0.5, y + 0.5) + offset(), worker.tile.points.of(e), out);
        }
        out.sum = std::ldexp(static_cast<double>(sum), -kWeightBits);
        return out;
    }

  private:
    using Offsets = std::span<const glm::dvec2>;

    glm::dvec2 offset() const { return in_.film.debug_offset_px; }

    /// What the owners of a map's weights are.
    struct MapOwners {
        MapOwners(const OwnerClasses& triangles, const VisibleMap& map)
            : classes(triangles.ofMap(map.stacks, stacks)) {}
        LayerStacks stacks;
        OwnerClasses classes;
    };

    /// Those that shade alike as one, for the picture; and each by itself, for the AOVs.
    struct BandOwners {
        BandOwners(const OwnerClasses& triangles, const VisibleMap& map, bool apart) : alike(triangles, map) {
            if (apart) each.emplace(OwnerClasses{}, map);
        }
        MapOwners alike;
        std::optional<MapOwners> each;
    };

    void reportOwner(std::span<const Owner> layers, FixedWeight fixed, glm::dvec2 sample, Offsets offsets,
                     PixelReport& out) const {
        requireShadable(layers, sample - offset());
        const double weight = std::ldexp(static_cast<double>(fixed), -kWeightBits);
        const auto add = [&](std::size_t k, double share, const glm::dvec3& color) {
            out.owners.push_back(
                {layers[k], weight * share, color, {layers.begin(), layers.begin() + k + 1}});
        };
        const auto shade = [&](Owner o) {
            return offsets.size() > 1 ? shading_.mean(o, sample, offsets)
                                      : shadeTriangle(o, offsets.empty() ? sample : sample + offsets[0]);
        };
        out.background += weight * throughLayers(layers, shade, add);
    }

    Shade shadeTriangle(Owner owner, glm::dvec2 sample_px) const {
        if (!plan_.constant.empty() && plan_.constant[owner]) return *plan_.constant[owner];
        return shading_.closest(owner, sample_px);
    }

    Shade shadeAt(std::span<const Owner> layers, glm::dvec2 sample_px) const {
        requireShadable(layers, sample_px - offset());
        return composite(
            layers, [&](Owner o) { return shadeTriangle(o, sample_px); }, in_.options.background);
    }

    /// The mean of whole stacks: their layers' opacities belong together.
    Shade shade(std::span<const Owner> layers, glm::dvec2 sample_px, Offsets offsets) const {
        const auto constant = [&](Owner o) {
            return o == kBackground || (!plan_.constant.empty() && plan_.constant[o]);
        };
        if (offsets.empty() || std::all_of(layers.begin(), layers.end(), constant))
            return shadeAt(layers, sample_px);
        Shade sum{glm::dvec3(0.0), 0.0};
        for (const glm::dvec2& offset : offsets) {
            const Shade one = shadeAt(layers, sample_px + offset);
            sum.color += one.color, sum.alpha += one.alpha;
        }
        const auto count = static_cast<double>(offsets.size());
        return {sum.color / count, sum.alpha / count};
    }

    /// What stays as long as the picture is made: the image, the scene on the screen, the plan's tables.
    std::size_t residentBytes() const {
        const auto bytes = [](const auto& items) { return items.size() * sizeof(items[0]); };
        return result_.image.bytes() + bytes(screen_.triangles) + bytes(screen_.planes) +
               bytes(pieces_.first) + bytes(pieces_.back_facing) + bytes(pieces_.plane_normal_eye) +
               bytes(plan_.constant) + bytes(plan_.classes.representative);
    }

    /// The other buffers share what --memory leaves.
    Bands cutIntoBands(const PixelBox& crop) {
        checkCancelled(in_.progress);
        in_.progress.stage("gather", 0);
        const CellGrid grid(windowOf(crop, offset(), reachOf(in_.filter)));
        requireLattice(grid, in_.options.memory_mib << 20);
        const IdLists lists = gather(screen_, grid);
        counts_["cell_triangle_pairs"] = lists.ids.size();
        const std::size_t limit = in_.options.memory_mib << 20;
        if (residentBytes() >= limit)
            throw FailureError("--memory",
                               fmt::format("the image and the projected triangles alone need {} MiB",
                                           (residentBytes() >> 20) + 1));
        watch_.book("gather", result_.stages);
        return Bands(crop, grid, lists, reachOf(in_.filter), offset(), limit - residentBytes());
    }

    VisibleMap visibleMapOf(const PixelBox& box) {
        const CellGrid grid(windowOf(box, offset(), reachOf(in_.filter)));
        const IdLists lists = gather(screen_, grid);
        dump_.gather(grid, lists);
        watch_.book("gather", result_.stages);
        VisibleMap map = visibility(screen_, grid, lists, plan_.visibility, in_.progress, visibility_counts_);
        watch_.book("visibility", result_.stages);
        counts_["segments"] += map.segments.size();
        counts_["stacks"] += map.stacks.size();
        return map;
    }

    void renderBand(const PixelBox& band) {
        checkCancelled(in_.progress);
        const VisibleMap map = visibleMapOf(band);
        const BandOwners owners(plan_.classes, map, aov_.weighs() && !plan_.classes.representative.empty());
        dump_.segments(map, band, offset());
        const WeightTiles tiles = gatherSegments(map, band, offset(), in_.filter.radius);
        watch_.book("gather", result_.stages);
        tbb::enumerable_thread_specific<TileWorker> workers([&] {
            return TileWorker{WeightWorker(in_.filter, plan_.weights), {}, {}, {}};
        });
        in_.progress.stage(nameOf(band), tiles.boxes.size());
        tbb::parallel_for(std::size_t{0}, tiles.boxes.size(), [&](std::size_t t) {
            checkCancelled(in_.progress);
            renderTile(map, owners, tiles, t, workers.local());
            in_.progress.advance(1);
        });
        bookTiles(workers, watch_.lap());
    }

    /// Says how far the picture is where it is made in several bands.
    std::string nameOf(const PixelBox& band) const {
        const PixelBox& crop = in_.film.crop;
        if (band.height() == crop.height()) return "weights";
        return fmt::format("weights to row {} of {}", band.y1 - crop.y0, crop.height());
    }

    void renderTile(const VisibleMap& map, const BandOwners& owners, const WeightTiles& tiles, std::size_t t,
                    TileWorker& worker) {
        const auto& lists = tiles.segments;
        const auto ids =
            std::span(lists.ids).subspan(lists.offsets[t], lists.offsets[t + 1] - lists.offsets[t]);
        Stopwatch watch;
        worker.weights.run(map, ids, owners.alike.classes, tiles.boxes[t], offset(), worker.tile);
        watch.book("weights", worker.times);
        if (aov_.weighs()) {
            fillAovs(map, owners, ids, worker);
            watch.book("aov", worker.times);
        }
        dump_.weights(worker.tile, owners.alike.stacks);
        worker.pairs += worker.tile.entries.size();
        blend(
            worker.tile, offset(),
            [&](Owner o, glm::dvec2 s, Offsets at) { return shade(owners.alike.stacks.layersOf(o), s, at); },
            result_.image);
        watch.book("blend", worker.times);
    }

    /// Owners stand for themselves here, not for all that shade alike: where the picture's weights were
    /// merged, they are computed once more, so that the picture keeps its bits whatever the AOVs.
    void fillAovs(const VisibleMap& map, const BandOwners& owners, std::span<const std::uint32_t> ids,
                  TileWorker& worker) {
        if (!owners.each) return aov_.tile(worker.tile, owners.alike.stacks, result_.image);
        worker.weights.run(map, ids, owners.each->classes, worker.tile.box, offset(), worker.every_owner);
        aov_.tile(worker.every_owner, owners.each->stacks, result_.image);
    }

    /// Stages share the tile loop: its wall time is divided as its threads' time was.
    void bookTiles(tbb::enumerable_thread_specific<TileWorker>& workers, double wall) {
        double total = 0.0;
        for (const TileWorker& w : workers)
            for (const StageTime& s : w.times) total += s.seconds;
        for (const TileWorker& w : workers) {
            for (const StageTime& s : w.times) bookSeconds(s.name, wall * s.seconds / total);
            counts_["terms"] += w.weights.terms();
            counts_["interior_pixels"] += w.weights.interiorPixels();
            counts_["label_conflicts"] += w.weights.labelConflicts();
            counts_["pixel_owner_pairs"] += w.pairs;
        }
    }

    void bookSeconds(const std::string& name, double seconds) {
        for (StageTime& known : result_.stages)
            if (known.name == name) return void(known.seconds += seconds);
        result_.stages.push_back({name, seconds});
    }

    void fillCounts(std::size_t bands) {
        counts_["triangles"] = in_.scene.triangle_count;
        counts_["screen_triangles"] = screen_.triangles.size();
        counts_["bands"] = bands;
        counts_["cells_swept"] = visibility_counts_.cells;
        counts_["cells_certified"] = visibility_counts_.certified;
        counts_["slabs"] = visibility_counts_.slabs;
        counts_["depth_lines"] = visibility_counts_.depth_lines;
        counts_["exact_depths"] = visibility_counts_.exact_depth;
        counts_["hidden_pairs"] = visibility_counts_.hidden;
        result_.counts = counts_;
        reportAovs(aov_, result_);
    }

    const MethodInput& in_;
    MethodResult result_;
    Stopwatch watch_;
    ScreenPieces pieces_;
    ScreenScene screen_;
    Shading shading_;
    Plan plan_;
    AovPass aov_;
    StageDump dump_;
    VisibilityCounts visibility_counts_;
    std::map<std::string, std::uint64_t> counts_;
};

}  // namespace

MethodResult runNsaa(const MethodSpec&, const MethodInput& input) {
    return Nsaa(input).render();
}

PixelReport pixelWeights(const MethodInput& input, int x, int y) {
    return Nsaa(input).report(x, y);
}

}  // namespace edgewise
