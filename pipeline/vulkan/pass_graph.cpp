#include "pipeline/vulkan/pass_graph.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace edgewise::vulkan {
namespace {

/// Everything that was written is seen by everything that follows, the host among it.
void barrier(const vk::raii::CommandBuffer& commands) {
    using Stage = vk::PipelineStageFlagBits;
    const vk::MemoryBarrier all(vk::AccessFlagBits::eMemoryWrite,
                                vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite);
    commands.pipelineBarrier(Stage::eAllCommands, Stage::eAllCommands | Stage::eHost, {}, all, {}, {});
}

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

const Buffer& PassContext::operator[](Resource resource) const {
    return graph[resource];
}

Resource PassGraph::buffer(std::string name, std::function<std::size_t()> bytes) {
    nodes_.push_back({std::move(name), std::move(bytes), nullptr, std::nullopt});
    return static_cast<Resource>(nodes_.size() - 1);
}

Resource PassGraph::input(std::string name, const Buffer& filled) {
    nodes_.push_back({std::move(name), {}, &filled, std::nullopt});
    return static_cast<Resource>(nodes_.size() - 1);
}

void PassGraph::add(std::string name, Pass pass) {
    assert(!pass.record != !pass.host);
    passes_.push_back({std::move(name), std::move(pass)});
}

const Buffer& PassGraph::operator[](Resource resource) const {
    const Node& node = nodes_[resource];
    assert(node.external || node.own);
    return node.external ? *node.external : *node.own;
}

Buffer PassGraph::take(Resource resource) {
    assert(nodes_[resource].own);
    Buffer taken = std::move(*nodes_[resource].own);
    nodes_[resource].own.reset();
    return taken;
}

/// Backwards: a pass is needed when it writes what is needed; then what it reads and writes is needed too.
std::vector<std::size_t> PassGraph::needed(const std::vector<Resource>& wanted) const {
    std::vector<bool> want(nodes_.size(), false);
    for (const Resource resource : wanted) want[resource] = true;
    std::vector<std::size_t> chosen;
    for (std::size_t i = passes_.size(); i-- > 0;) {
        const Pass& pass = passes_[i].pass;
        if (std::none_of(pass.writes.begin(), pass.writes.end(), [&](Resource r) { return want[r]; }))
            continue;
        chosen.push_back(i);
        for (const Resource resource : pass.reads) want[resource] = true;
        for (const Resource resource : pass.writes) want[resource] = true;
    }
    std::reverse(chosen.begin(), chosen.end());
    return chosen;
}

std::vector<std::string> PassGraph::plan(const std::vector<Resource>& wanted) const {
    std::vector<std::string> names;
    for (const std::size_t i : needed(wanted)) names.push_back(passes_[i].name);
    return names;
}

void PassGraph::allocate(const Pass& pass) {
    for (const std::vector<Resource>* list : {&pass.reads, &pass.writes})
        for (const Resource resource : *list) {
            Node& node = nodes_[resource];
            if (node.external) continue;
            const std::size_t bytes = node.size();
            if (!node.own || node.own->bytes() < bytes) {
                node.own.reset();
                node.own.emplace(device_, node.name, bytes);
            }
        }
}

/// One submission for passes between which the host has nothing to do.
void PassGraph::runBatch(const std::vector<std::size_t>& batch) {
    if (batch.empty()) return;
    const vk::raii::CommandBuffers lists(device_.handle(),
                                         {*device_.commandPool(), vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = lists.front();
    const auto marks = static_cast<std::uint32_t>(batch.size() + 1);
    const vk::raii::QueryPool clock(device_.handle(),
                                    vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, marks));
    commands.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    commands.resetQueryPool(*clock, 0, marks);
    const bool timed = device_.traits().tick_ns > 0.0;
    for (std::uint32_t k = 0; k < batch.size(); ++k) {
        if (timed) commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *clock, k);
        passes_[batch[k]].pass.record({*this, commands});
        barrier(commands);
    }
    if (timed) commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *clock, marks - 1);
    commands.end();
    const auto start = std::chrono::steady_clock::now();
    device_.run(commands);
    const double wall = secondsSince(start);
    std::vector<std::uint64_t> ticks(marks, 0);
    if (timed)
        ticks = clock
                    .getResults<std::uint64_t>(0, marks, 8 * marks, 8,
                                               vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
                    .second;
    for (std::size_t k = 0; k < batch.size(); ++k)
        times_.push_back({passes_[batch[k]].name,
                          static_cast<double>(ticks[k + 1] - ticks[k]) * device_.traits().tick_ns * 1e-9});
    // A program on the CPU marks the end of its last dispatch before it has done it: the rest is that one's.
    if (!device_.traits().real_gpu)
        times_.back().seconds += std::max(
            0.0, wall - static_cast<double>(ticks.back() - ticks.front()) * device_.traits().tick_ns * 1e-9);
}

void PassGraph::run(const std::vector<Resource>& wanted) {
    times_.clear();
    std::vector<std::size_t> batch;
    for (const std::size_t i : needed(wanted)) {
        const Pass& pass = passes_[i].pass;
        if (pass.host) {
            runBatch(batch);
            batch.clear();
            allocate(pass);
            const auto start = std::chrono::steady_clock::now();
            pass.host(*this);
            times_.push_back({passes_[i].name, secondsSince(start)});
            continue;
        }
        allocate(pass);
        batch.push_back(i);
    }
    runBatch(batch);
}

std::size_t PassGraph::bytes() const {
    std::size_t sum = 0;
    for (const Node& node : nodes_)
        if (node.own) sum += node.own->bytes();
    return sum;
}

}  // namespace edgewise::vulkan
