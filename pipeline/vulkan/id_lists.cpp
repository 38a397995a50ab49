#include "pipeline/vulkan/id_lists.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/error.h"
#include "pipeline/vulkan/layouts.h"

namespace edgewise::vulkan {
namespace {

std::size_t roomOf(std::size_t entries) {
    return 2 * entries * sizeof(uint);
}

void sortLongLists(const PassGraph& graph, const DeviceLists& lists, std::size_t count) {
    const auto offsets = graph[lists.offsets].read<uint>(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t size = offsets[i + 1] - offsets[i];
        if (size <= kSortLongest) continue;
        const auto ids = graph[lists.ids].read<uint>(size, offsets[i] * sizeof(uint));
        std::vector<uint> sorted(ids.begin(), ids.end());
        std::sort(sorted.begin(), sorted.end());
        std::ranges::copy(sorted, graph[lists.ids].view<uint>(size, offsets[i] * sizeof(uint)).begin());
    }
}

}  // namespace

ListOrder::ListOrder(const Device& device)
    : device_(device), sort_(device, "sort_lists.comp", 2, sizeof(uint)) {}

Resource ListOrder::addRoom(PassGraph& graph, const std::string& name, Resource offsets, std::size_t lists) {
    const Resource ids = graph.buffer(
        name + " ids", [&graph, offsets, lists] { return roomOf(entriesOf(graph, offsets, lists)); });
    // The host must have seen the offsets before the buffer is made.
    graph.add(name + " room", {.reads = {offsets}, .writes = {ids}, .host = [](const PassGraph&) {}});
    return ids;
}

void ListOrder::addSort(PassGraph& graph, const std::string& name, const DeviceLists& lists,
                        std::size_t count) {
    const auto push = static_cast<uint>(count);
    graph.add(name + " sort", {.reads = {lists.offsets, lists.ids},
                               .writes = {lists.ids},
                               .record = [=, this](const PassContext& pass) {
                                   sort_.dispatch(pass.commands, {pass[lists.offsets], pass[lists.ids]},
                                                  Groups::covering(count, 64), push);
                               }});
    graph.add(name + " long lists", {.reads = {lists.offsets, lists.ids},
                                     .writes = {lists.ids},
                                     .host = [=](const PassGraph& g) { sortLongLists(g, lists, count); }});
}

}  // namespace edgewise::vulkan
