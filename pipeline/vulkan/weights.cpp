#include "pipeline/vulkan/weights.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

#include "analytic/segment_tiles.h"

namespace edgewise::vulkan {
namespace {

/// Of a box's sums, 8 bytes an owner of a tile and pixel: as many entries at most, of 32 bytes when they are
/// shaded.
constexpr std::size_t kMostSumBytes = std::size_t{30} << 20;

/// Of a box's pairs of a segment and a pixel, and their notes.
constexpr std::size_t kMostPairBytes = std::size_t{80} << 20;
constexpr std::size_t kPairBytes = sizeof(GpuPair) + kNotesPerPair * sizeof(GpuBorderNote);

constexpr std::uint32_t kGroup = 64;
constexpr std::size_t kTilePixels = std::size_t{kTilePx} * kTilePx;

Buffer numbersOf(const Device& device, const WeightKernel& kernel, Precision precision) {
    assert(kernel.numbers.size() <= kKernelNumbers);
    std::vector<double> all = kernel.numbers;
    all.resize(kKernelNumbers, 0.0);
    if (precision == Precision::kFp64) return bufferOf(device, "kernel", all);
    return bufferOf(device, "kernel", std::vector<float>(all.begin(), all.end()));
}

const char* shaderOf(Precision precision) {
    return precision == Precision::kFp64 ? "weights_fp64.comp" : "weights_fp32.comp";
}

/// Between dispatches that read what the last has written.
void waitFor(vk::PipelineStageFlags stage, vk::AccessFlags writes, const vk::raii::CommandBuffer& commands) {
    const vk::MemoryBarrier written(writes,
                                    vk::AccessFlagBits::eShaderRead | vk::AccessFlagBits::eShaderWrite);
    commands.pipelineBarrier(stage, vk::PipelineStageFlagBits::eComputeShader, {}, written, {}, {});
}

}  // namespace

/// Made by the host: which pixel of the box, and its entries.
struct HandedPixel {
    std::size_t pixel;
    std::vector<OwnerWeight> entries;
};

/// Ids of the map's segments, as the lists' entries from `begin` on name them.
struct HandedSegments {
    std::size_t begin = 0;
    std::vector<std::uint32_t> ids;
};

/// The tiles of a box among those of the lists.
struct BoxTiles {
    BoxTiles(const WeightLists& lists, const PixelBox& box)
        : columns(static_cast<std::size_t>((box.width() + kTilePx - 1) / kTilePx)),
          rows(static_cast<std::size_t>((box.height() + kTilePx - 1) / kTilePx)),
          first(lists.tileAt(box.x0, box.y0)),
          list_columns(lists.columns()) {
        sum_first.push_back(0);
        for (std::size_t t = 0; t < columns * rows; ++t) {
            const std::size_t at = listed(t);
            pairs += lists.pair_begin[at + 1] - lists.pair_begin[at];
            sum_first.push_back(sum_first.back() + lists.slot_begin[at + 1] - lists.slot_begin[at]);
        }
    }
    std::size_t count() const { return columns * rows; }
    std::size_t listed(std::size_t tile) const {
        return first + tile / columns * list_columns + tile % columns;
    }

    std::size_t columns, rows, first, list_columns;
    std::size_t pairs = 0;
    std::vector<uint> sum_first;  ///< by tile: owners before it; and the end
};

/// One box.
struct WeightPasses::Job {
    Job(const Device& device, const WeightLists& of, const PixelBox& pixels_of)
        : lists(of),
          box(pixels_of),
          tiles(of, pixels_of),
          sum_first(bufferOf(device, "owners before", tiles.sum_first)) {
        assert((box.x0 - of.input.area.x0) % kTilePx == 0 && (box.y0 - of.input.area.y0) % kTilePx == 0);
    }

    std::size_t pixels() const { return static_cast<std::size_t>(box.width()) * box.height(); }
    std::size_t sumBytes() const { return tiles.sum_first.back() * kTilePixels * sizeof(FixedWeight); }
    std::size_t pairBytes() const { return tiles.pairs * kPairBytes; }
    WeightPush push(const LaneKernel& kernel, Groups groups) const {
        return {kernel.radius,
                kernel.inner_radius,
                kernel.radius + f64::kReachSlackPx,
                lists.input.offset_px.x,
                lists.input.offset_px.y,
                box.x0,
                box.y0,
                box.width(),
                box.height(),
                static_cast<uint>(tiles.count()),
                static_cast<uint>(tiles.columns),
                0,
                0,
                0,
                lists.map->rowBegin(),
                groups.x,
                static_cast<uint>(tiles.first),
                static_cast<uint>(tiles.list_columns)};
    }

    const WeightLists& lists;
    const PixelBox box;
    const BoxTiles tiles;
    const Buffer sum_first;
    Resource pairs = 0, notes = 0, sums = 0, states = 0, kinds = 0, counts = 0, reports = 0, handed_list = 0,
             out_offsets = 0, out_owners = 0, out_weights = 0;
    std::vector<HandedPixel> handed;

    std::size_t listedTileOf(std::size_t pixel) const {
        const auto width = static_cast<std::size_t>(box.width());
        return lists.tileAt(box.x0 + static_cast<int>(pixel % width),
                            box.y0 + static_cast<int>(pixel / width));
    }

    /// The segments of all tiles from the first handed pixel's to the last one's: read at once.
    HandedSegments segmentsOfHanded() const {
        std::size_t first = lists.entry_begin.size(), last = 0;
        for (const HandedPixel& pixel : handed) {
            first = std::min(first, listedTileOf(pixel.pixel));
            last = std::max(last, listedTileOf(pixel.pixel) + 1);
        }
        if (handed.empty()) return {};
        const std::size_t begin = lists.entry_begin[first], count = lists.entry_begin[last] - begin;
        HandedSegments segments{begin, {}};
        for (const GpuTileSegment& entry :
             lists.entries.read<GpuTileSegment>(count, begin * sizeof(GpuTileSegment)))
            segments.ids.push_back(lists.map->segment(entry.segment));
        return segments;
    }

    std::vector<OwnerWeight> makeOnHost(std::size_t pixel, const HandedSegments& segments,
                                        WeightWorker& worker) const {
        const auto width = static_cast<std::size_t>(box.width());
        const std::size_t tile = listedTileOf(pixel), begin = lists.entry_begin[tile];
        const auto ids =
            std::span(segments.ids).subspan(begin - segments.begin, lists.entry_begin[tile + 1] - begin);
        const int left = box.x0 + static_cast<int>(pixel % width),
                  top = box.y0 + static_cast<int>(pixel / width);
        WeightTile made;
        worker.run(lists.input.map, ids, lists.input.classes, {left, top, left + 1, top + 1},
                   lists.input.offset_px, made);
        return made.entries;
    }

    void insertHanded(const PassGraph& graph) const {
        if (handed.empty()) return;
        const auto at = graph[out_offsets].read<uint>(pixels() + 1);
        const auto out_owner = graph[out_owners].view<uint>(at[pixels()]);
        const auto out_weight = graph[out_weights].view<FixedWeight>(at[pixels()]);
        for (const HandedPixel& pixel : handed)
            for (std::size_t e = 0; e < pixel.entries.size(); ++e) {
                out_owner[at[pixel.pixel] + e] = pixel.entries[e].owner;
                out_weight[at[pixel.pixel] + e] = pixel.entries[e].weight;
            }
    }

    /// What a shader binds; `none` stands where it has nothing.
    std::vector<BufferRange> bindings(const Buffer& none) const {
        std::vector<BufferRange> all(kWeightBindings, BufferRange(none));
        all[kWeightSegments] = lists.map->segments(), all[kWeightLines] = lists.map->lines();
        all[kWeightOffsets] = lists.offsets, all[kWeightEntries] = lists.entries;
        all[kWeightSlots] = lists.slots, all[kWeightOwners] = lists.owners;
        all[kWeightRowOffsets] = lists.map->rowOffsets(), all[kWeightRows] = lists.map->rows();
        all[kWeightSumFirst] = sum_first, all[kWeightPairFirst] = lists.pair_first;
        return all;
    }
};

WeightPasses::WeightPasses(const Device& device, const Prefilter& filter, const WeightOptions& options)
    : device_(device),
      filter_(filter),
      options_(options),
      kernel_(filter, options.precision),
      numbers_(numbersOf(device, kernel_, options.precision)),
      lists_(device, filter.radius),
      pairs_(device, "weights_pairs.comp", kWeightBindings, sizeof(WeightPush)),
      terms_(device, shaderOf(options.precision), BufferSlots(kWeightBindings, kWeightNumbers),
             sizeof(WeightPush), kernel_.constants),
      finish_(device, "weights_finish.comp", kWeightBindings, sizeof(WeightPush),
              {kernel_.kernel.lanes.form != kStripTerm ? 1u : 0u,
               static_cast<std::uint32_t>(grantedTurns(device.traits()) / 2)}),
      fill_(device, "weights_fill.comp", kWeightBindings, sizeof(WeightPush)),
      scan_(device) {}

std::optional<WeightEntries> WeightPasses::addTo(PassGraph& graph, const WeightLists& lists,
                                                 const PixelBox& box) {
    const auto job = std::make_shared<Job>(device_, lists, box);
    if (job->sumBytes() > kMostSumBytes || job->pairBytes() > kMostPairBytes) return std::nullopt;
    addPairs(graph, job);
    addTerms(graph, job);
    addFinish(graph, job);
    addFill(graph, job);
    return WeightEntries{job->out_offsets, job->out_owners, job->out_weights,
                         [=, &graph] { return entriesOf(graph, job->out_offsets, job->pixels()); }};
}

/// A dispatch a row of tiles: their entries follow one another.
void WeightPasses::recordPairs(const PassContext& pass, const Job& job) {
    pairs_.forgetSets();
    auto buffers = job.bindings(numbers_);
    buffers[kWeightPairs] = pass[job.pairs];
    uint named = 0;
    for (std::size_t row = 0; row < job.tiles.rows; ++row) {
        const std::size_t first = job.tiles.listed(row * job.tiles.columns), end = first + job.tiles.columns;
        const uint entry = job.lists.entry_begin[first], count = job.lists.entry_begin[end] - entry;
        const Groups groups = Groups::inRows((count + kGroup - 1) / kGroup);
        WeightPush push = job.push(kernel_.kernel.lanes, groups);
        push.first = entry, push.count = count, push.pairs_before = job.lists.pair_begin[first] - named;
        if (count > 0) pairs_.dispatch(pass.commands, buffers, groups, push);
        named += job.lists.pair_begin[end] - job.lists.pair_begin[first];
    }
}

void WeightPasses::addPairs(PassGraph& graph, const std::shared_ptr<Job>& job) {
    job->pairs = graph.buffer("pairs", [=] { return job->tiles.pairs * sizeof(GpuPair); });
    graph.add("weights pairs", {.reads = {},
                                .writes = {job->pairs},
                                .record = [=, this](const PassContext& pass) { recordPairs(pass, *job); }});
}

void WeightPasses::recordTerms(const PassContext& pass, const Job& job) {
    terms_.forgetSets();
    for (const Resource empty : {job.sums, job.states})
        pass.commands.fillBuffer(pass[empty].handle(), 0, VK_WHOLE_SIZE, 0);
    waitFor(vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferWrite, pass.commands);
    auto buffers = job.bindings(numbers_);
    buffers[kWeightPairs] = pass[job.pairs], buffers[kWeightNotes] = pass[job.notes];
    buffers[kWeightSums] = pass[job.sums], buffers[kWeightStates] = pass[job.states];
    const Groups groups = Groups::inRows((job.tiles.pairs + kGroup - 1) / kGroup);
    WeightPush push = job.push(kernel_.kernel.lanes, groups);
    push.count = static_cast<uint>(job.tiles.pairs);
    if (push.count > 0) terms_.dispatch(pass.commands, buffers, groups, push);
}

void WeightPasses::addTerms(PassGraph& graph, const std::shared_ptr<Job>& job) {
    job->notes = graph.buffer("border notes",
                              [=] { return job->tiles.pairs * kNotesPerPair * sizeof(GpuBorderNote); });
    job->sums = graph.buffer("sums", [=] { return job->sumBytes(); });
    job->states = graph.buffer("pixel states",
                               [=] { return job->tiles.count() * kTilePixels * sizeof(GpuPixelState); });
    graph.add("weights", {.reads = {job->pairs},
                          .writes = {job->notes, job->sums, job->states},
                          .record = [=, this](const PassContext& pass) { recordTerms(pass, *job); }});
}

void WeightPasses::addFinish(PassGraph& graph, const std::shared_ptr<Job>& job) {
    job->kinds =
        graph.buffer("pixel kinds", [=] { return job->tiles.count() * kTilePixels * 2 * sizeof(uint); });
    job->counts = graph.buffer("entry counts", [=] { return job->pixels() * sizeof(uint); });
    job->reports = graph.buffer("tile reports", [=] { return job->tiles.count() * sizeof(GpuTileReport); });
    job->handed_list = graph.buffer("pixels handed back", [=] { return (1 + job->pixels()) * sizeof(uint); });
    graph.add(
        "weights finish",
        {.reads = {job->notes, job->sums, job->states},
         .writes = {job->sums, job->kinds, job->counts, job->reports, job->handed_list},
         .record = [=, this](const PassContext& pass) {
             pass.commands.fillBuffer(pass[job->reports].handle(), 0, VK_WHOLE_SIZE, 0);
             pass.commands.fillBuffer(pass[job->handed_list].handle(), 0, sizeof(uint), 0);
             waitFor(vk::PipelineStageFlagBits::eTransfer, vk::AccessFlagBits::eTransferWrite, pass.commands);
             auto buffers = job->bindings(numbers_);
             buffers[kWeightReports] = pass[job->reports], buffers[kWeightHanded] = pass[job->handed_list];
             buffers[kWeightNotes] = pass[job->notes];
             buffers[kWeightSums] = pass[job->sums], buffers[kWeightStates] = pass[job->states];
             buffers[kWeightPixels] = pass[job->kinds], buffers[kWeightCounts] = pass[job->counts];
             finish_.forgetSets();
             const Groups groups = Groups::inRows(job->tiles.count());
             finish_.dispatch(pass.commands, buffers, groups, job->push(kernel_.kernel.lanes, groups));
         }});
    graph.add("weights on the host", {.reads = {job->reports, job->handed_list, job->counts},
                                      .writes = {job->counts},
                                      .host = [=, this](const PassGraph& g) { makeOnHost(g, *job); }});
}

/// Counts what the device has made, and makes the pixels that it handed back.
void WeightPasses::makeOnHost(const PassGraph& graph, Job& job) {
    for (const GpuTileReport& tile : graph[job.reports].read<GpuTileReport>(job.tiles.count()))
        report_.terms += tile.terms, report_.interior_pixels += tile.whole;
    const uint handed_back = graph[job.handed_list].read<uint>(1)[0];
    report_.handed += handed_back;
    job.handed.clear();
    for (const uint pixel : graph[job.handed_list].read<uint>(handed_back, sizeof(uint)))
        job.handed.push_back({pixel, {}});
    const auto counts = graph[job.counts].view<uint>(job.pixels());
    tbb::enumerable_thread_specific<WeightWorker> workers([&] { return WeightWorker(filter_, options_); });
    const HandedSegments segments = job.segmentsOfHanded();
    tbb::parallel_for(std::size_t{0}, job.handed.size(), [&](std::size_t i) {
        HandedPixel& handed = job.handed[i];
        handed.entries = job.makeOnHost(handed.pixel, segments, workers.local());
        counts[handed.pixel] = static_cast<uint>(handed.entries.size());
    });
    for (const WeightWorker& w : workers) report_.label_conflicts += w.labelConflicts();
}

void WeightPasses::addFill(PassGraph& graph, const std::shared_ptr<Job>& job) {
    job->out_offsets = scan_.addTo(graph, "weights", job->counts, job->pixels());
    const auto entries = [=, &graph] { return entriesOf(graph, job->out_offsets, job->pixels()); };
    job->out_owners = graph.buffer("entry owners", [=] { return entries() * sizeof(uint); });
    job->out_weights = graph.buffer("entry weights", [=] { return entries() * sizeof(FixedWeight); });
    // the host must have seen the offsets before the buffers are made
    graph.add("weights room", {.reads = {job->out_offsets},
                               .writes = {job->out_owners, job->out_weights},
                               .host = [=, this](const PassGraph&) { report_.pairs += entries(); }});
    graph.add("weights fill",
              {.reads = {job->sums, job->kinds, job->out_offsets},
               .writes = {job->out_owners, job->out_weights},
               .record = [=, this](const PassContext& pass) {
                   auto buffers = job->bindings(numbers_);
                   buffers[kWeightSums] = pass[job->sums], buffers[kWeightPixels] = pass[job->kinds];
                   buffers[kWeightOutOffsets] = pass[job->out_offsets];
                   buffers[kWeightOutOwners] = pass[job->out_owners];
                   buffers[kWeightOutWeights] = pass[job->out_weights];
                   fill_.forgetSets();
                   const Groups groups = Groups::inRows(job->tiles.count());
                   fill_.dispatch(pass.commands, buffers, groups, job->push(kernel_.kernel.lanes, groups));
               }});
    graph.add("weights from the host", {.reads = {job->out_offsets, job->out_owners, job->out_weights},
                                        .writes = {job->out_owners, job->out_weights},
                                        .host = [=](const PassGraph& g) { job->insertHanded(g); }});
}

}  // namespace edgewise::vulkan
