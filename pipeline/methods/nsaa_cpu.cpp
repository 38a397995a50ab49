#include "pipeline/methods/nsaa_cpu.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace edgewise {

/// One thread's scratch, and the time that its two stages took.
struct CpuStages::TileWorker {
    WeightWorker weights;
    WeightTile tile, every_owner;
    std::vector<StageTime> times;
    std::uint64_t pairs = 0;
};

VisibleMap CpuStages::visibleMap(NsaaFrame& frame, const CellGrid& grid) {
    const IdLists lists = frame.gatherOnHost(grid);
    frame.dump.gather(grid, lists);
    frame.watch.book("gather", frame.result.stages);
    VisibleMap map = visibility(frame.screen, grid, lists, frame.plan.visibility, frame.in.progress,
                                frame.visibility_counts);
    frame.watch.book("visibility", frame.result.stages);
    return map;
}

WeightTile CpuStages::weights(NsaaFrame& frame, const VisibleMap& map, const OwnerClasses& classes,
                              const PixelBox& box) {
    const WeightTiles tiles = gatherSegments(map, box, frame.offset(), frame.in.filter.radius);
    WeightWorker worker(frame.in.filter, frame.plan.weights);
    WeightTile tile;
    worker.run(map, tiles.segments.ids, classes, box, frame.offset(), tile);
    return tile;
}

void CpuStages::render(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                       const PixelBox& band) {
    const WeightTiles tiles = gatherSegments(map, band, frame.offset(), frame.in.filter.radius);
    frame.watch.book("gather", frame.result.stages);
    tbb::enumerable_thread_specific<TileWorker> workers([&] {
        return TileWorker{WeightWorker(frame.in.filter, frame.plan.weights), {}, {}, {}};
    });
    frame.in.progress.stage(nameOf(band, frame.in.film.crop), tiles.boxes.size());
    tbb::parallel_for(std::size_t{0}, tiles.boxes.size(), [&](std::size_t t) {
        checkCancelled(frame.in.progress);
        renderTile(frame, map, owners, tiles, t, workers.local());
        frame.in.progress.advance(1);
    });
    bookTiles(frame, workers, frame.watch.lap());
}

void CpuStages::renderTile(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                           const WeightTiles& tiles, std::size_t t, TileWorker& worker) {
    const auto& lists = tiles.segments;
    const auto ids = std::span(lists.ids).subspan(lists.offsets[t], lists.offsets[t + 1] - lists.offsets[t]);
    Stopwatch watch;
    worker.weights.run(map, ids, owners.alike.classes, tiles.boxes[t], frame.offset(), worker.tile);
    watch.book("weights", worker.times);
    if (frame.aov.weighs()) {
        fillAovs(frame, map, owners, ids, worker);
        watch.book("aov", worker.times);
    }
    frame.dump.weights(worker.tile, owners.alike.stacks);
    worker.pairs += worker.tile.entries.size();
    finishTile(frame, owners, worker.tile);
    watch.book("blend", worker.times);
}

/// Owners stand for themselves here, not for all that shade alike: where the picture's weights were
/// merged, they are computed once more, so that the picture keeps its bits whatever the AOVs.
void CpuStages::fillAovs(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                         std::span<const std::uint32_t> ids, TileWorker& worker) {
    ImageBuffer& image = frame.result.image;
    if (!owners.each) return frame.aov.tile(worker.tile, owners.alike.stacks, image);
    worker.weights.run(map, ids, owners.each->classes, worker.tile.box, frame.offset(), worker.every_owner);
    frame.aov.tile(worker.every_owner, owners.each->stacks, image);
}

/// Stages share the tile loop: its wall time is divided as its threads' time was.
template <class Workers>
void CpuStages::bookTiles(NsaaFrame& frame, Workers& workers, double wall) {
    double total = 0.0;
    for (const TileWorker& w : workers)
        for (const StageTime& s : w.times) total += s.seconds;
    for (const TileWorker& w : workers) {
        for (const StageTime& s : w.times) frame.bookSeconds(s.name, wall * s.seconds / total);
        frame.counts["terms"] += w.weights.terms();
        frame.counts["interior_pixels"] += w.weights.interiorPixels();
        frame.counts["label_conflicts"] += w.weights.labelConflicts();
        frame.counts["pixel_owner_pairs"] += w.pairs;
    }
}

}  // namespace edgewise
