#include "pipeline/vulkan/weight_lists.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "analytic/segment_tiles.h"

namespace edgewise::vulkan {
namespace {

constexpr std::uint32_t kGroup = 64;

/// Invocations that may share one count of turns.
constexpr std::size_t kTogether = 16;

/// Of a list's buffers: more is halved, whatever a binding may hold.
constexpr std::size_t kMostListBytes = std::size_t{256} << 20;

/// What prefix sums of more than 32 bits come to.
constexpr uint kOverflow = 0xffffffff;

std::vector<uint> copyOf(const Buffer& buffer, std::size_t count) {
    const auto items = buffer.read<uint>(count);
    return {items.begin(), items.end()};
}

std::size_t longestOf(const std::vector<uint>& begin) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < begin.size(); ++i)
        longest = std::max<std::size_t>(longest, begin[i] - begin[i - 1]);
    return longest;
}

}  // namespace

/// One area. The lists know their sizes in two steps, so each is a graph of its own.
struct WeightListPasses::Job {
    const WeightMap& map;
    WeightListPush push;
    Resource segments = 0, histogram = 0, offsets = 0, entries = 0, sides = 0, firsts = 0, places = 0,
             slots = 0, owners = 0, pair_counts = 0, pair_first = 0;
    std::optional<Buffer> counted, offset_buffer;
    std::vector<PassTime> times;

    Job(const WeightInput& in, const WeightMap& on_device, double radius)
        : map(on_device),
          push{in.offset_px.x,
               in.offset_px.y,
               radius + f64::kReachSlackPx,
               in.area.x0,
               in.area.y0,
               static_cast<uint>((in.area.width() + kTilePx - 1) / kTilePx),
               static_cast<uint>((in.area.height() + kTilePx - 1) / kTilePx),
               static_cast<uint>(on_device.size()),
               0} {}

    std::size_t tiles() const { return std::size_t{push.columns} * push.rows; }

    void dispatch(const PassContext& pass, ComputePass& shader, const std::vector<BufferRange>& buffers,
                  std::size_t groups) const {
        WeightListPush at = push;
        at.group_row = Groups::inRows(groups).x;
        shader.dispatch(pass.commands, buffers, Groups::inRows(groups), at);
    }

    /// By binding; `segments` stands where there is nothing.
    std::vector<BufferRange> bindings(const PassContext& pass,
                                      std::initializer_list<std::pair<int, Resource>> bound) const {
        std::vector<BufferRange> all(kListBindings, BufferRange(pass[segments]));
        for (const auto& [binding, resource] : bound) all[static_cast<std::size_t>(binding)] = pass[resource];
        return all;
    }
};

WeightListPasses::WeightListPasses(const Device& device, double radius)
    : device_(device),
      radius_(radius),
      count_(device, "weights_reach.comp", kListBindings, sizeof(WeightListPush), {0}),
      fill_(device, "weights_reach.comp", kListBindings, sizeof(WeightListPush), {1}),
      firsts_(device, "weights_firsts.comp", kListBindings, sizeof(WeightListPush)),
      places_(device, "weights_places.comp", kListBindings, sizeof(WeightListPush)),
      scan_(device),
      order_(device) {}

void WeightListPasses::addCount(PassGraph& graph, const Job& job) {
    graph.add("weights clear",
              {.reads = {}, .writes = {job.histogram}, .record = [&job](const PassContext& pass) {
                   pass.commands.fillBuffer(pass[job.histogram].handle(), 0, VK_WHOLE_SIZE, 0);
               }});
    graph.add("weights count", {.reads = {job.segments, job.histogram},
                                .writes = {job.histogram},
                                .record = [&job, this](const PassContext& pass) {
                                    job.dispatch(pass, count_,
                                                 job.bindings(pass, {{kListHistogram, job.histogram}}),
                                                 Groups::covering(job.map.size(), kGroup).x);
                                }});
}

void WeightListPasses::addFill(PassGraph& graph, const Job& job) {
    graph.add("weights list", {.reads = {job.segments, job.histogram, job.offsets},
                               .writes = {job.histogram, job.entries, job.sides, job.pair_counts},
                               .record = [&job, this](const PassContext& pass) {
                                   job.dispatch(pass, fill_,
                                                job.bindings(pass, {{kListHistogram, job.histogram},
                                                                    {kListOffsets, job.offsets},
                                                                    {kListEntries, job.entries},
                                                                    {kListSides, job.sides},
                                                                    {kListPairCounts, job.pair_counts}}),
                                                Groups::covering(job.map.size(), kGroup).x);
                               }});
    order_.addSort(graph, "weights", {job.offsets, job.sides}, job.tiles());
    graph.add("weights firsts", {.reads = {job.offsets, job.sides},
                                 .writes = {job.firsts},
                                 .record = [&job, this](const PassContext& pass) {
                                     job.dispatch(pass, firsts_,
                                                  job.bindings(pass, {{kListOffsets, job.offsets},
                                                                      {kListSides, job.sides},
                                                                      {kListFirsts, job.firsts}}),
                                                  job.tiles());
                                 }});
}

void WeightListPasses::addPlaces(PassGraph& graph, const Job& job) {
    // the host must have seen the sums before the owners' buffer is made
    graph.add("weights owners room",
              {.reads = {job.places}, .writes = {job.owners}, .host = [](const PassGraph&) {}});
    graph.add("weights places", {.reads = {job.offsets, job.sides, job.places, job.entries},
                                 .writes = {job.slots, job.owners, job.entries},
                                 .record = [&job, this](const PassContext& pass) {
                                     job.dispatch(pass, places_,
                                                  job.bindings(pass, {{kListOffsets, job.offsets},
                                                                      {kListSides, job.sides},
                                                                      {kListPlaces, job.places},
                                                                      {kListEntries, job.entries},
                                                                      {kListSlots, job.slots},
                                                                      {kListOwners, job.owners}}),
                                                  job.tiles());
                                 }});
}

/// Whether one segment's tiles fit the turns of loops: of each row of them it sees what lies within reach,
/// and one at either end; a row's neighbours within reach see that again.
bool WeightListPasses::reachFits(const Job& job) const {
    const double reach_tiles = std::ceil(2.0 * job.push.reach / kTilePx);
    const double row = reach_tiles + 4.0, most = job.push.rows * row + job.push.columns * (reach_tiles + 2.0);
    return most * kTogether <= static_cast<double>(grantedTurns(device_.traits()));
}

/// Sides sort with twice their room; a workgroup looks each entry's two owners up, as many entries at a time
/// as it has invocations.
bool WeightListPasses::listsFit(const std::vector<uint>& begin) const {
    const std::size_t most = std::min(device_.traits().max_storage_bytes, kMostListBytes);
    if (begin.back() > most / (2 * sizeof(uint))) return false;
    const std::size_t longest = longestOf(begin), search = std::bit_width(longest) + 1;
    return (longest / kGroup + 1) * (2 + search) <= grantedTurns(device_.traits());
}

/// How many sides every tile has, and the sums before it.
void WeightListPasses::count(Job& job) {
    PassGraph graph(device_);
    job.segments = graph.input("segments", job.map.segments());
    job.histogram = graph.buffer("tile histogram", [tiles = job.tiles()] { return tiles * sizeof(uint); });
    addCount(graph, job);
    job.offsets = scan_.addTo(graph, "weights", job.histogram, job.tiles());
    graph.run({job.offsets});
    job.counted.emplace(graph.take(job.histogram));
    job.offset_buffer.emplace(graph.take(job.offsets));
    job.times = graph.times();
}

WeightLists WeightListPasses::list(Job& job, const WeightInput& input, const std::vector<uint>& begin) {
    PassGraph graph(device_);
    const std::size_t sides = begin.back();
    const auto words = [](std::size_t count) { return [count] { return count * sizeof(uint); }; };
    job.segments = graph.input("segments", job.map.segments());
    job.histogram = graph.input("tile histogram", *job.counted);
    job.offsets = graph.input("tile offsets", *job.offset_buffer);
    job.entries = graph.buffer("tile segments", [=] { return sides / 2 * sizeof(GpuTileSegment); });
    job.sides = graph.buffer("tile sides", words(2 * sides));
    job.firsts = graph.buffer("first sides", words(sides));
    job.slots = graph.buffer("tile slots", words(job.tiles() + 1));
    job.pair_counts = graph.buffer("pair counts", words(sides / 2));
    addFill(graph, job);
    job.pair_first = scan_.addTo(graph, "weights pairs", job.pair_counts, sides / 2);
    job.places = scan_.addTo(graph, "weights places", job.firsts, sides);
    job.owners = graph.buffer("tile owners", [&graph, sides, places = job.places] {
        return entriesOf(graph, places, sides) * sizeof(uint);
    });
    addPlaces(graph, job);
    graph.run({job.entries, job.slots, job.owners, job.pair_first});
    job.times.insert(job.times.end(), graph.times().begin(), graph.times().end());
    WeightLists lists{input,
                      {},
                      std::move(*job.offset_buffer),
                      graph.take(job.entries),
                      graph.take(job.slots),
                      graph.take(job.owners),
                      graph.take(job.pair_first),
                      begin,
                      {},
                      {},
                      std::move(job.times)};
    for (uint& entry : lists.entry_begin) entry /= 2;
    lists.slot_begin = copyOf(lists.slots, job.tiles() + 1);
    const auto pairs = lists.pair_first.read<uint>(sides / 2 + 1);
    for (const uint entry : lists.entry_begin) lists.pair_begin.push_back(pairs[entry]);
    return lists;
}

std::optional<WeightLists> WeightListPasses::make(const WeightInput& input) {
    for (ComputePass* pass : {&count_, &fill_, &firsts_, &places_}) pass->forgetSets();
    std::shared_ptr<const WeightMap> map = input.on_device;
    if (!map) {
        auto part =
            WeightMap::around(device_, input.map, input.classes, input.area, input.offset_px, radius_);
        if (!part) return std::nullopt;
        map = std::make_shared<const WeightMap>(std::move(*part));
    }
    Job job(input, *map, radius_);
    if (!reachFits(job)) return std::nullopt;
    count(job);
    const std::vector<uint> begin = copyOf(*job.offset_buffer, job.tiles() + 1);
    if (!listsFit(begin)) return std::nullopt;
    WeightLists lists = list(job, input, begin);
    if (lists.pair_begin.back() == kOverflow) return std::nullopt;
    lists.map = std::move(map);
    return lists;
}

}  // namespace edgewise::vulkan
