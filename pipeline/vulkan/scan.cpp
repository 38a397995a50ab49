#include "pipeline/vulkan/scan.h"

#include "pipeline/vulkan/layouts.h"

namespace edgewise::vulkan {

Scan::Scan(const Device& device)
    : reduce_(device, "scan.comp", 3, sizeof(uint), {1, 0}),
      scan_(device, "scan.comp", 3, sizeof(uint), {0, 0}),
      scan_based_(device, "scan.comp", 3, sizeof(uint), {0, 1}) {}

/// Blocks are summed up, their sums scanned in turn, and each block's scan starts from there.
Resource Scan::addTo(PassGraph& graph, const std::string& name, Resource counts, std::size_t count) {
    const auto items = static_cast<uint>(count);
    const std::size_t blocks = std::max<std::size_t>(1, (count + kScanBlock - 1) / kScanBlock);
    const Resource offsets = graph.buffer(name + " offsets", [count] { return (count + 1) * sizeof(uint); });
    const Groups groups{static_cast<std::uint32_t>(blocks)};
    Resource before = counts;  // none
    if (blocks > 1) {
        const Resource sums = graph.buffer(name + " sums", [blocks] { return blocks * sizeof(uint); });
        graph.add(
            name + " reduce",
            {.reads = {counts}, .writes = {sums}, .record = [=, this](const PassContext& pass) {
                 reduce_.dispatch(pass.commands, {pass[counts], pass[counts], pass[sums]}, groups, items);
             }});
        before = addTo(graph, name + " sums", sums, blocks);
    }
    graph.add(name + " scan",
              {.reads = {counts, before}, .writes = {offsets}, .record = [=, this](const PassContext& pass) {
                   (blocks > 1 ? scan_based_ : scan_)
                       .dispatch(pass.commands, {pass[counts], pass[before], pass[offsets]}, groups, items);
               }});
    return offsets;
}

}  // namespace edgewise::vulkan
