#include "pipeline/vulkan/resolve.h"

#include <algorithm>

namespace edgewise::vulkan {
namespace {

using bits64 = std::int64_t;
#include "shaders/shared/resolve.glsl"

/// Of one invocation: at most 16 run together, each at its own pace.
std::size_t mostTurns(const DeviceTraits& traits) {
    return traits.loop_turns / 16;
}

constexpr std::size_t kMostSlots = 64;

std::size_t sideOf(const ResolveTable& table) {
    return 2 * table.margin_px + 1;
}

/// What the walk over a window leaves to the search for slots.
uint turnsOfAdding(const ResolveTable& table, const DeviceTraits& traits) {
    const std::size_t walk = 2 * table.weights.size() + kMostSlots;  // a step may end a run; writing
    const std::size_t most = mostTurns(traits);
    return static_cast<uint>(walk < most ? most - walk : most);
}

/// Of all samples of the pixel that starts there; none is reached: kUnreached.
void sumUp(SampleWalk& walk, std::size_t first, std::size_t count) {
    std::int64_t& sum = walk.pixel_weights[first];
    for (std::size_t k = first; k < first + count; ++k)
        if (walk.weights[k] != kUnreached) sum = (sum == kUnreached ? 0 : sum) + walk.weights[k];
}

SampleWalk walkOver(const ResolveTable& table) {
    const auto side = static_cast<uint>(sideOf(table)), columns = static_cast<uint>(table.columns),
               rows = static_cast<uint>(table.rows);
    SampleWalk walk;
    for (uint p = 0; p < side * side; ++p) {
        const std::size_t first = walk.places.size();
        for (uint s = 0; s < rows * columns; ++s) {
            const uint x = p % side * columns + s % columns, y = p / side * rows + s / columns;
            walk.places.push_back({x, y, s == 0 ? p % side : kInsidePixel, p / side});
            walk.weights.push_back(table.weights[std::size_t{y} * side * columns + x]);
            walk.pixel_weights.push_back(kUnreached);
        }
        sumUp(walk, first, rows * columns);
    }
    return walk;
}

/// Owners that an invocation holds: a workgroup's all lie in shared memory.
uint slotsOn(const Device& device) {
    const std::size_t room = device.traits().max_shared_bytes / (kResolveGroup * (sizeof(uint) + 8));
    return static_cast<uint>(std::min(room, kMostSlots));
}

Groups groupsOf(uint width, uint height) {
    return {(width + 7) / 8, (height + 7) / 8};
}

std::size_t pixelsOf(const PixelBox& box) {
    return static_cast<std::size_t>(box.width()) * box.height();
}

}  // namespace

const std::int64_t kResolveUnreached = kUnreached;

bool Resolve::isShortEnough(const ResolveTable& table, const DeviceTraits& traits) {
    return 4 * table.weights.size() <= mostTurns(traits);
}

Resolve::Resolve(const Device& device, const ResolveTable& table) : Resolve(device, table, walkOver(table)) {}

Resolve::Resolve(const Device& device, const ResolveTable& table, const SampleWalk& walk)
    : table_(table),
      weights_(bufferOf(device, "sample weights", walk.weights)),
      pixel_weights_(bufferOf(device, "pixel weights", walk.pixel_weights)),
      places_(bufferOf(device, "sample places", walk.places)),
      scan_(device),
      uniform_(device, "uniform_pixels.comp", 2, sizeof(ResolvePush)),
      whole_(device, "resolve_whole.comp", kResolveBindings, sizeof(ResolvePush)),
      resolve_(device, "resolve.comp", kResolveBindings, sizeof(ResolvePush),
               {turnsOfAdding(table, device.traits()), slotsOn(device)}),
      order_(device, "order_entries.comp", kOrderBindings, sizeof(OrderPush)) {}

std::size_t Resolve::roomFor(const PixelBox& box) {
    return pixelsOf(box) > kMostEntries / 2 ? 0 : std::min(kMostEntries, pixelsOf(box) * (1 + kMostSlots));
}

ResolvePush Resolve::pushFor(const PixelBox& box) const {
    const int around = 2 * table_.margin_px;
    return {static_cast<uint>(box.width()),          static_cast<uint>(box.height()),
            static_cast<uint>(box.width() + around), static_cast<uint>(box.height() + around),
            static_cast<uint>(table_.margin_px),     static_cast<uint>(table_.columns),
            static_cast<uint>(table_.rows),          static_cast<uint>(roomFor(box)),
            Groups::kMostInRow * kResolveGroup};
}

Resolve::Resolved Resolve::addTo(PassGraph& graph, Resource samples, const PixelBox& box) {
    const ResolvePush push = pushFor(box);
    const auto words = [](std::size_t count) { return [count] { return count * sizeof(uint); }; };
    const std::size_t room = push.room;
    const Resource uniform =
        graph.buffer("uniform pixels", words(std::size_t{push.window_width} * push.window_height));
    const Resolved out{graph.buffer("resolved counts", words(pixelsOf(box))),
                       graph.buffer("resolved first", words(pixelsOf(box))),
                       graph.buffer("resolved owners", words(room)),
                       graph.buffer("resolved weights", [room] { return room * sizeof(std::int64_t); }),
                       graph.buffer("resolved status", [] { return sizeof(ResolveStatus); }),
                       graph.buffer("mixed pixels", words(pixelsOf(box)))};
    addPasses(graph, samples, uniform, out, box);
    return out;
}

void Resolve::addPasses(PassGraph& graph, Resource samples, Resource uniform, const Resolved& out,
                        const PixelBox& box) {
    const ResolvePush push = pushFor(box);
    const auto buffers = [=, this](const PassContext& pass) {
        return std::vector<BufferRange>{pass[samples],    pass[uniform],     weights_,        pixel_weights_,
                                        pass[out.counts], pass[out.status],  pass[out.first], pass[out.mixed],
                                        pass[out.owners], pass[out.weights], places_};
    };
    const std::vector<Resource> lists{out.counts, out.first, out.owners, out.weights, out.status};
    uniform_.forgetSets(), whole_.forgetSets(), resolve_.forgetSets();
    graph.add(
        "weights uniform",
        {.reads = {samples}, .writes = {uniform, out.status}, .record = [=, this](const PassContext& pass) {
             pass.commands.updateBuffer<ResolveStatus>(pass[out.status].handle(), 0,
                                                       ResolveStatus{push.width * push.height, 0, 0});
             uniform_.dispatch(pass.commands, {pass[samples], pass[uniform]},
                               groupsOf(push.window_width, push.window_height), push);
         }});
    graph.add("weights whole",
              {.reads = {samples, uniform, out.status},
               .writes = {out.counts, out.first, out.owners, out.weights, out.status, out.mixed},
               .record = [=, this](const PassContext& pass) {
                   whole_.dispatch(pass.commands, buffers(pass), groupsOf(push.width, push.height), push);
               }});
    // How many are mixed is known to the host before they are dispatched.
    graph.add("weights mixed", {.reads = {out.status}, .writes = lists, .host = [](const PassGraph&) {}});
    graph.add("weights resolve",
              {.reads = {samples, uniform, out.mixed, out.status},
               .writes = lists,
               .record = [=, this](const PassContext& pass) {
                   const uint mixed = pass[out.status].read<ResolveStatus>(1)[0].mixed;
                   // One at least: the first draw compiles what there is to compile.
                   const std::uint32_t groups = std::max(1u, Groups::covering(mixed, kResolveGroup).x);
                   resolve_.dispatch(pass.commands, buffers(pass), Groups::inRows(groups), push);
               }});
}

Resolve::Lists Resolve::addOrder(PassGraph& graph, const Resolved& resolved, const PixelBox& box,
                                 std::size_t entries) {
    constexpr std::uint32_t kGroup = 64;
    const Resource offsets = scan_.addTo(graph, "weights", resolved.counts, pixelsOf(box));
    const Lists out{offsets, graph.buffer("entry owners", [entries] { return entries * sizeof(uint); }),
                    graph.buffer("entry weights", [entries] { return entries * sizeof(std::int64_t); })};
    const Groups groups = Groups::inRows(Groups::covering(pixelsOf(box), kGroup).x);
    const OrderPush push{static_cast<uint>(pixelsOf(box)), groups.x * kGroup};
    order_.forgetSets();
    graph.add("weights order", {.reads = {resolved.first, offsets, resolved.owners, resolved.weights},
                                .writes = {out.owners, out.weights},
                                .record = [=, this](const PassContext& pass) {
                                    order_.dispatch(
                                        pass.commands,
                                        {pass[resolved.first], pass[offsets], pass[resolved.owners],
                                         pass[resolved.weights], pass[out.owners], pass[out.weights]},
                                        groups, push);
                                }});
    return out;
}

}  // namespace edgewise::vulkan
