// Passes that say what they read and write: what feeds nothing that is wanted is never allocated, run or
// timed.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "pipeline/vulkan/buffer.h"

namespace edgewise::vulkan {

/// Names a buffer of the graph.
using Resource = std::uint32_t;

class PassGraph;

/// What a pass sees while it is recorded.
struct PassContext {
    const PassGraph& graph;
    const vk::raii::CommandBuffer& commands;
    const Buffer& operator[](Resource resource) const;
};

struct Pass {
    std::vector<Resource> reads;
    std::vector<Resource> writes;  ///< reads of earlier contents count as reads too
    /// Commands of the device. Between passes everything written is made visible.
    std::function<void(const PassContext&)> record = {};
    /// Work of the host on mapped buffers, after all passes before it have finished: counts become sizes
    /// here.
    std::function<void(const PassGraph&)> host = {};
};

struct PassTime {
    std::string name;
    double seconds = 0.0;  ///< of the device, or of the host
};

/// Runs in the order in which passes were added. Buffers live in the graph and are reused by its next run
/// where they are large enough.
class PassGraph {
  public:
    explicit PassGraph(const Device& device) : device_(device) {}

    /// A buffer that passes write; its size is asked when the first pass that uses it is due.
    Resource buffer(std::string name, std::function<std::size_t()> bytes);
    /// A buffer of the caller's, filled already; it outlives the graph's runs.
    Resource input(std::string name, const Buffer& filled);
    void add(std::string name, Pass pass);

    /// The names of the passes that `wanted` needs, in order.
    std::vector<std::string> plan(const std::vector<Resource>& wanted) const;

    /// Runs just these. Throws FailureError where the device fails.
    void run(const std::vector<Resource>& wanted);

    /// Of a resource that the last run made or was given.
    const Buffer& operator[](Resource resource) const;

    /// The buffer leaves the graph, which does without it from now on.
    Buffer take(Resource resource);

    /// Of the last run, by pass.
    const std::vector<PassTime>& times() const { return times_; }
    /// Bytes of all buffers that the graph holds.
    std::size_t bytes() const;

  private:
    struct Node {
        std::string name;
        std::function<std::size_t()> size;
        const Buffer* external = nullptr;
        std::optional<Buffer> own;
    };
    struct NamedPass {
        std::string name;
        Pass pass;
    };
    std::vector<std::size_t> needed(const std::vector<Resource>& wanted) const;
    void allocate(const Pass& pass);
    void runBatch(const std::vector<std::size_t>& batch);

    const Device& device_;
    std::vector<Node> nodes_;
    std::vector<NamedPass> passes_;
    std::vector<PassTime> times_;
};

}  // namespace edgewise::vulkan
