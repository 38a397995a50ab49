// A picture whose entries the CPU's stages make, shaded and blended by both: how far the device is from the
// CPU.
#pragma once

#include <chrono>
#include <cstring>

#include "pipeline/gather.h"
#include "pipeline/methods/nsaa_frame.h"
#include "pipeline/visibility.h"
#include "pipeline/vulkan/blend.h"
#include "pipeline/vulkan/shade.h"
#include "tests/vulkan/test_device.h"

namespace edgewise::vulkan::test {

/// Steps between two float32.
inline double ulpsBetween(double a, double b) {
    const auto order = [](double x) {
        const auto value = static_cast<float>(x);
        std::int32_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        return bits < 0 ? -static_cast<double>(bits & 0x7fffffff) : static_cast<double>(bits);
    };
    return std::abs(order(a) - order(b));
}

struct Comparison {
    std::string why_not;  ///< the device does not shade this scene
    std::uint32_t uses = 0;
    std::size_t uploaded_bytes = 0;
    std::size_t pixels = 0, entries = 0, points = 0, stacks = 0;
    std::size_t differing = 0;  ///< pixels with a double that has other bits
    std::size_t edges_differing = 0, edges = 0;
    double worst_ulps = 0.0;  ///< of float32
    std::size_t handed_back = 0;
    double first_seconds = 0.0;  ///< pipelines made, and the first run
    double shade_seconds = 0.0, blend_seconds = 0.0, cpu_seconds = 0.0;
};

/// The stages of the CPU, and after them shade and blend of the device.
class DeviceShading final : public NsaaStages {
  public:
    Comparison found;
    bool timed = false;  ///< runs twice, so that the second compiles nothing

    VisibleMap visibleMap(NsaaFrame& frame, const CellGrid& grid) override {
        return visibility(frame.screen, grid, gather(frame.screen, grid), frame.plan.visibility,
                          frame.in.progress, frame.visibility_counts);
    }
    WeightTile weights(NsaaFrame& frame, const VisibleMap& map, const OwnerClasses& classes,
                       const PixelBox& box) override {
        const WeightTiles tiles = gatherSegments(map, box, frame.offset(), frame.in.filter.radius);
        WeightWorker worker(frame.in.filter, frame.plan.weights);
        WeightTile tile;
        worker.run(map, tiles.segments.ids, classes, box, frame.offset(), tile);
        return tile;
    }
    void render(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                const PixelBox& band) override {
        band_ = band;
        gatherEntries(frame, map, owners.alike);
        shadeOnDevice(frame, owners.alike.stacks);
    }

  private:
    void gatherEntries(NsaaFrame& frame, const VisibleMap& map, const MapOwners& owners) {
        const WeightTiles tiles = gatherSegments(map, band_, frame.offset(), frame.in.filter.radius);
        WeightWorker worker(frame.in.filter, frame.plan.weights);
        std::vector<WeightTile> done(tiles.boxes.size());
        for (std::size_t t = 0; t < done.size(); ++t) {
            const auto& lists = tiles.segments;
            const auto ids =
                std::span(lists.ids).subspan(lists.offsets[t], lists.offsets[t + 1] - lists.offsets[t]);
            worker.run(map, ids, owners.classes, tiles.boxes[t], frame.offset(), done[t]);
            const auto start = std::chrono::steady_clock::now();
            frame.blendTile(done[t], owners.stacks);
            found.cpu_seconds += secondsSince(start);
        }
        join(done);
    }

    static double secondsSince(std::chrono::steady_clock::time_point start) {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    /// Tiles' entries in the order of the band's pixels.
    void join(const std::vector<WeightTile>& tiles) {
        offsets_ = {0}, owners_.clear(), weights_.clear(), point_ends_.clear(), points_.clear();
        const int columns = (band_.width() + kWeightTilePx - 1) / kWeightTilePx;
        for (int y = band_.y0; y < band_.y1; ++y)
            for (int x = band_.x0; x < band_.x1; ++x) {
                const WeightTile& tile = tiles[static_cast<std::size_t>(
                    (y - band_.y0) / kWeightTilePx * columns + (x - band_.x0) / kWeightTilePx)];
                ASSERT_TRUE(tile.box.contains(x, y));
                const auto pixel =
                    static_cast<std::size_t>((y - tile.box.y0) * tile.box.width() + (x - tile.box.x0));
                for (std::size_t e = tile.offset[pixel]; e < tile.offset[pixel + 1]; ++e) addEntry(tile, e);
                offsets_.push_back(static_cast<std::uint32_t>(owners_.size()));
            }
    }

    void addEntry(const WeightTile& tile, std::size_t e) {
        owners_.push_back(tile.entries[e].owner);
        weights_.push_back(tile.entries[e].weight);
        const auto points = tile.points.of(e);
        points_.insert(points_.end(), points.begin(), points.end());
        point_ends_.push_back(static_cast<std::uint32_t>(points_.size()));
        found.stacks += isStack(owners_.back());
    }

    void shadeOnDevice(NsaaFrame& frame, const LayerStacks& stacks) {
        const ShadingMode mode = frame.in.options.shading.mode;
        const bool has_points = mode == ShadingMode::kCentroid || mode == ShadingMode::kSamples;
        const ShadeTables tables =
            makeShadeTables({frame.in.scene, frame.in.camera, frame.in.film, frame.screen, frame.pieces,
                             frame.shading, frame.plan.constant, frame.in.options.background, has_points});
        if (const auto why = whyNotShaded(tables, device().traits())) return void(found.why_not = *why);
        const StackTables layers(stacks);
        const Buffer triangles = bufferOf(device(), "triangles", frame.screen.triangles),
                     offsets = bufferOf(device(), "offsets", offsets_),
                     owners = bufferOf(device(), "owners", owners_),
                     weights = bufferOf(device(), "weights", weights_),
                     stack_first = bufferOf(device(), "stacks", layers.first),
                     stack_layers = bufferOf(device(), "layers", layers.layers),
                     ends = bufferOf(device(), "point ends", point_ends_),
                     points = bufferOf(device(), "points", points_);
        PassGraph graph(device());
        const auto start = std::chrono::steady_clock::now();
        ShadePass shade(device(), tables);
        BlendPass blend(device());
        ShadeEntries entries{graph.input("triangles", triangles),
                             graph.input("offsets", offsets),
                             graph.input("owners", owners),
                             {},
                             {},
                             {},
                             {},
                             [this] { return band_; },
                             [this] { return owners_.size(); }};
        if (tables.uses & kUsesStacks)
            entries.stack_first = graph.input("stacks", stack_first),
            entries.stack_layers = graph.input("layers", stack_layers);
        if (has_points)
            entries.point_ends = graph.input("point ends", ends),
            entries.points = graph.input("points", points);
        const Resource shades =
            shade.addTo(graph, entries, [&](std::size_t e) { return onHost(frame, stacks, e); });
        const BlendedPixels out =
            blend.addTo(graph, {entries.offsets, graph.input("weights", weights), shades, entries.box});
        graph.run({out.rgba, out.edge});
        found.first_seconds += secondsSince(start);
        if (timed) graph.run({out.rgba, out.edge});
        for (const PassTime& time : graph.times())
            (time.name.starts_with("shade") ? found.shade_seconds : found.blend_seconds) += time.seconds;
        found.uses |= tables.uses;
        found.uploaded_bytes += shade.scene().bytes();
        found.handed_back += shade.handedBack();
        compare(frame, graph[out.rgba].read<glm::dvec4>(offsets_.size() - 1),
                graph[out.edge].read<float>(offsets_.size() - 1));
    }

    Shade onHost(const NsaaFrame& frame, const LayerStacks& stacks, std::size_t e) const {
        std::size_t pixel = 0;
        while (offsets_[pixel + 1] <= e) ++pixel;
        const auto width = static_cast<std::size_t>(band_.width());
        const glm::dvec2 sample = glm::dvec2(band_.x0 + static_cast<int>(pixel % width) + 0.5,
                                             band_.y0 + static_cast<int>(pixel / width) + 0.5) +
                                  frame.offset();
        const std::size_t begin = e == 0 ? 0 : point_ends_[e - 1];
        return frame.shade(stacks.layersOf(owners_[e]), sample,
                           std::span(points_).subspan(begin, point_ends_[e] - begin));
    }

    void compare(const NsaaFrame& frame, std::span<const glm::dvec4> rgba, std::span<const float> edge) {
        std::size_t p = 0;
        for (int y = band_.y0; y < band_.y1; ++y)
            for (int x = band_.x0; x < band_.x1; ++x, ++p) {
                const std::size_t i = frame.result.image.index(x, y);
                const glm::dvec4& expected = frame.result.image.rgba[i];
                for (int c = 0; c < 4; ++c)
                    found.worst_ulps = std::max(found.worst_ulps, ulpsBetween(expected[c], rgba[p][c]));
                found.differing += expected != rgba[p];
                found.edges += frame.result.image.edge[i] != 0.0f;
                found.edges_differing += frame.result.image.edge[i] != edge[p];
            }
        found.pixels += p, found.entries += owners_.size(), found.points += points_.size();
    }

    PixelBox band_;
    std::vector<std::uint32_t> offsets_, owners_, point_ends_;
    std::vector<std::int64_t> weights_;
    std::vector<glm::dvec2> points_;
};

inline Comparison comparePicture(const Scene& scene, const ResolvedCamera& camera, const Film& film,
                                 const Prefilter& filter, const RenderOptions& options = {},
                                 bool timed = false) {
    Progress progress;
    DeviceShading stages;
    stages.timed = timed;
    NsaaFrame({scene, camera, film, filter, options, progress}).render(stages);
    return stages.found;
}

}  // namespace edgewise::vulkan::test
