// nsaa on a Vulkan device, from gather to blend. Every stage has the CPU's bits, and so has the picture.
#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "pipeline/composite.h"
#include "pipeline/methods/box_halves.h"
#include "pipeline/methods/nsaa_cpu.h"
#include "pipeline/methods/registry.h"
#include "pipeline/vulkan/blend.h"
#include "pipeline/vulkan/gather.h"
#include "pipeline/vulkan/shade.h"
#include "pipeline/vulkan/visibility.h"
#include "pipeline/vulkan/weights.h"

namespace edgewise {
namespace {

using namespace vulkan;

/// The rows that are shaded at once, whole weight tiles high: what the device holds of a band beside its map.
constexpr int kStripRows = 4 * kWeightTilePx;

/// Two tables of four doubles an entry would not be bound by a device of 128 MiB beyond this.
constexpr std::size_t kMostEntries = 4'000'000;

/// The entries of a strip in the order of its pixels.
struct StripEntries {
    std::vector<std::uint32_t> offsets{0}, owners, point_ends;
    std::vector<FixedWeight> weights;
    std::vector<glm::dvec2> points;

    void add(const WeightTile& tile, std::size_t pixel) {
        for (std::size_t e = tile.offset[pixel]; e < tile.offset[pixel + 1]; ++e) {
            owners.push_back(tile.entries[e].owner);
            weights.push_back(tile.entries[e].weight);
            const auto of = tile.points.of(e);
            points.insert(points.end(), of.begin(), of.end());
            point_ends.push_back(static_cast<std::uint32_t>(points.size()));
        }
        offsets.push_back(static_cast<std::uint32_t>(owners.size()));
    }
};

bool hasPoints(const NsaaFrame& frame) {
    const ShadingMode mode = frame.in.options.shading.mode;
    return mode == ShadingMode::kCentroid || mode == ShadingMode::kSamples;
}

std::optional<std::string> whyNotWeighed(const NsaaFrame& frame) {
    if (hasPoints(frame)) return "--shading centroid and samples:N find their points there";
    if (frame.aov.weighs()) return "the AOVs ask for the weights of every owner";
    return vulkan::whyNotWeighed(frame.in.filter);
}

ShadeTables tablesOf(const NsaaFrame& frame) {
    return makeShadeTables({frame.in.scene, frame.in.camera, frame.in.film, frame.screen, frame.pieces,
                            frame.shading, frame.plan.constant, frame.in.options.background,
                            hasPoints(frame)});
}

class VulkanStages : public CpuStages {
  public:
    explicit VulkanStages(NsaaFrame& frame)
        : triangles_(bufferOf(device_, "triangles", frame.screen.triangles)),
          planes_(bufferOf(device_, "planes", frame.screen.planes)),
          gather_(device_),
          visibility_(device_) {
        const ShadeTables tables = tablesOf(frame);
        why_not_shaded_ = whyNotShaded(tables, device_.traits());
        if (!why_not_shaded_) shade_.emplace(device_, tables), blend_.emplace(device_), uses_ = tables.uses;
        why_not_weighed_ = whyNotWeighed(frame);
        if (!why_not_weighed_) weights_.emplace(device_, frame.in.filter, frame.plan.weights);
        frame.result.device = "vulkan";
        frame.result.setup_seconds = frame.watch.lap();
    }

    VisibleMap visibleMap(NsaaFrame& frame, const CellGrid& grid) override {
        frame.dropLists();
        PassGraph graph(device_);
        const Resource triangles = graph.input("triangles", triangles_),
                       planes = graph.input("planes", planes_);
        const DeviceLists lists = gather_.addTo(graph, triangles, frame.screen.triangles.size(), grid);
        const MapResources map = visibility_.addTo(graph, triangles, planes, lists.offsets, lists.ids, [&] {
            return VisibilityInput{frame.screen, grid, frame.plan.visibility.cell};
        });
        graph.run({map.segments, map.lines, map.row_offsets, map.row_owners});
        if (frame.dump.active()) frame.dump.gather(grid, readBack(graph, lists, grid));
        bookMap(frame, graph);
        return visibility_.map();
    }

    void render(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                const PixelBox& band) override {
        if (why_not_shaded_) return CpuStages::render(frame, map, owners, band);
        const auto weigh_on_host = [&](const PixelBox& strip) {
            weighStripOnHost(frame, map, owners, strip);
        };
        if (why_not_weighed_) return forStrips(frame, band, weigh_on_host);
        std::shared_ptr<const WeightMap> on_device;
        if (auto all = WeightMap::ofAll(device_, map, owners.alike.classes))
            on_device = std::make_shared<const WeightMap>(std::move(*all));
        weighArea(frame, {map, owners.alike.classes, band, frame.offset(), on_device}, owners);
    }

    WeightTile weights(NsaaFrame& frame, const VisibleMap& map, const OwnerClasses& classes,
                       const PixelBox& box) override {
        if (why_not_weighed_) return CpuStages::weights(frame, map, classes, box);
        const auto lists = weights_->listsOf({map, classes, box, frame.offset(), nullptr});
        PassGraph graph(device_);
        const auto entries = lists ? weights_->addTo(graph, *lists, box) : std::nullopt;
        if (!entries) return CpuStages::weights(frame, map, classes, box);
        graph.run({entries->offsets, entries->owners, entries->weights});
        return readBack(graph, *entries, box);
    }

    void report(MethodResult& result) const {
        result.counts["device_leaves"] = report_.leaves;
        result.counts["cells_handed_back"] = report_.handed;
        result.counts["entries_handed_back"] = handed_entries_;
        const WeightReport weighed = weights_ ? weights_->report() : WeightReport{};
        result.counts["terms"] += weighed.terms;
        result.counts["interior_pixels"] += weighed.interior_pixels;
        result.counts["label_conflicts"] += weighed.label_conflicts;
        result.counts["pixel_owner_pairs"] += weighed.pairs;
        result.counts["pixels_handed_back"] = weighed.handed;
        if (why_not_shaded_)
            result.notes.push_back("weighed, shaded and blended on the CPU: " + *why_not_shaded_);
        else if (why_not_weighed_)
            result.notes.push_back("weighed on the CPU: " + *why_not_weighed_);
    }

  protected:
    void finishTile(NsaaFrame& frame, const BandOwners& owners, WeightTile& tile) override {
        if (why_not_shaded_) return CpuStages::finishTile(frame, owners, tile);
        const std::scoped_lock lock(tiles_mutex_);
        tiles_.push_back(std::move(tile));
    }

  private:
    static IdLists readBack(const PassGraph& graph, const DeviceLists& lists, const CellGrid& grid) {
        IdLists out;
        const auto offsets = graph[lists.offsets].read<std::uint32_t>(grid.size() + 1);
        out.offsets.assign(offsets.begin(), offsets.end());
        const auto ids = graph[lists.ids].read<std::uint32_t>(offsets.back());
        out.ids.assign(ids.begin(), ids.end());
        return out;
    }

    /// The wall's time, in the proportion of what gather's and visibility's passes report.
    void bookMap(NsaaFrame& frame, const PassGraph& graph) {
        double gathering = 0.0;
        for (const PassTime& pass : graph.times())
            if (pass.name.starts_with("gather")) gathering += pass.seconds;
        const double wall = frame.watch.lap();
        gathering = std::min(gathering, wall);
        frame.bookSeconds("gather", gathering);
        frame.bookSeconds("visibility", wall - gathering);
        const VisibilityReport& made = visibility_.report();
        frame.visibility_counts.add(made.counts);
        report_.leaves += made.leaves, report_.handed += made.handed;
    }

    StripEntries joined(const PixelBox& strip) const {
        const int columns = (strip.width() + kWeightTilePx - 1) / kWeightTilePx;
        const auto slot = [&](int x, int y) {
            return static_cast<std::size_t>((y - strip.y0) / kWeightTilePx * columns +
                                            (x - strip.x0) / kWeightTilePx);
        };
        std::vector<const WeightTile*> at(tiles_.size());
        for (const WeightTile& tile : tiles_) at[slot(tile.box.x0, tile.box.y0)] = &tile;
        StripEntries entries;
        for (int y = strip.y0; y < strip.y1; ++y)
            for (int x = strip.x0; x < strip.x1; ++x) {
                const WeightTile& tile = *at[slot(x, y)];
                entries.add(
                    tile, static_cast<std::size_t>((y - tile.box.y0) * tile.box.width() + (x - tile.box.x0)));
            }
        return entries;
    }

    void weighStripOnHost(NsaaFrame& frame, const VisibleMap& map, const BandOwners& owners,
                          const PixelBox& strip) {
        tiles_.clear();
        CpuStages::render(frame, map, owners, strip);
        blendStrip(frame, owners.alike.stacks, strip);
        frame.bookSeconds("blend", frame.watch.lap());
    }

    void blendStrip(NsaaFrame& frame, const LayerStacks& stacks, const PixelBox& strip) {
        const StripEntries strip_entries = joined(strip);
        if (strip_entries.owners.size() > kMostEntries) {
            handed_entries_ += strip_entries.owners.size();
            for (const WeightTile& tile : tiles_) frame.blendTile(tile, stacks);
            return;
        }
        const Buffer offsets = bufferOf(device_, "offsets", strip_entries.offsets),
                     owners = bufferOf(device_, "owners", strip_entries.owners),
                     weights = bufferOf(device_, "weights", strip_entries.weights),
                     ends = bufferOf(device_, "point ends", strip_entries.point_ends),
                     points = bufferOf(device_, "points", strip_entries.points);
        PassGraph graph(device_);
        const WeightEntries entries{graph.input("offsets", offsets), graph.input("owners", owners),
                                    graph.input("weights", weights),
                                    [&] { return strip_entries.owners.size(); }};
        std::optional<EntryPoints> at;
        if (hasPoints(frame))
            at = EntryPoints{graph.input("point ends", ends), graph.input("points", points)};
        shadeAndBlend(frame, stacks, strip, graph, entries, at);
    }

    template <class Weigh>
    static void forStrips(const NsaaFrame& frame, const PixelBox& area, Weigh&& weigh) {
        for (int y = area.y0; y < area.y1; y += kStripRows) {
            checkCancelled(frame.in.progress);
            weigh(PixelBox{area.x0, y, area.x1, std::min(y + kStripRows, area.y1)});
        }
    }

    /// Halves what is too large for the device at once; a single tile is the host's.
    void weighArea(NsaaFrame& frame, const WeightInput& input, const BandOwners& owners) {
        const PixelBox& area = input.area;
        if (const auto lists = weights_->listsOf(input)) {
            frame.bookSeconds("weights", frame.watch.lap());
            return forStrips(frame, area,
                             [&](const PixelBox& strip) { weighStrip(frame, *lists, owners, strip); });
        }
        if (isSingleTile(area)) return weighStripOnHost(frame, input.map, owners, area);
        for (const PixelBox& half : halvesOf(area, kWeightTilePx))
            weighArea(frame, {input.map, input.classes, half, input.offset_px, input.on_device}, owners);
    }

    static bool isSingleTile(const PixelBox& box) {
        return std::max(box.width(), box.height()) <= kWeightTilePx;
    }

    /// Likewise.
    void weighStrip(NsaaFrame& frame, const WeightLists& lists, const BandOwners& owners,
                    const PixelBox& strip) {
        PassGraph graph(device_);
        const auto entries = weights_->addTo(graph, lists, strip);
        if (!entries) {
            if (isSingleTile(strip)) return weighStripOnHost(frame, lists.input.map, owners, strip);
            for (const PixelBox& half : halvesOf(strip, kWeightTilePx))
                weighStrip(frame, lists, owners, half);
            return;
        }
        shadeAndBlend(frame, owners.alike.stacks, strip, graph, *entries, std::nullopt);
        if (frame.dump.active()) frame.dump.weights(readBack(graph, *entries, strip), owners.alike.stacks);
        bookStrip(frame, graph);
    }

    struct EntryPoints {
        Resource ends, points;
    };

    void shadeAndBlend(NsaaFrame& frame, const LayerStacks& stacks, const PixelBox& box, PassGraph& graph,
                       const WeightEntries& weighed, const std::optional<EntryPoints>& points) {
        const StackTables layers(stacks);
        const Buffer first = bufferOf(device_, "stacks", layers.first),
                     list = bufferOf(device_, "layers", layers.layers);
        ShadeEntries entries{graph.input("triangles", triangles_),
                             weighed.offsets,
                             weighed.owners,
                             {},
                             {},
                             {},
                             {},
                             [&] { return box; },
                             weighed.count};
        if (uses_ & kUsesStacks) {
            entries.stack_first = graph.input("stacks", first);
            entries.stack_layers = graph.input("layers", list);
            requireShadableEntries(graph, stacks, box, weighed);
        }
        if (points) entries.point_ends = points->ends, entries.points = points->points;
        const Resource shades = shade_->addTo(graph, entries, [&](std::size_t e) {
            return shadeOnHost(frame, stacks, box, graph, entries, e);
        });
        const BlendedPixels out =
            blend_->addTo(graph, {weighed.offsets, weighed.weights, shades, entries.box});
        graph.run({out.rgba, out.edge});
        handed_entries_ += shade_->handedBack();
        copyPixels(graph, out, box, frame.result.image);
    }

    /// The device composites what it is given; the limit is asked here.
    static void requireShadableEntries(PassGraph& graph, const LayerStacks& stacks, const PixelBox& box,
                                       const WeightEntries& entries) {
        const auto ask = [&, entries](const PassGraph& g) {
            const auto pixels = static_cast<std::size_t>(box.width()) * box.height();
            const auto offsets = g[entries.offsets].read<std::uint32_t>(pixels + 1);
            const auto owners = g[entries.owners].read<std::uint32_t>(offsets[pixels]);
            for (std::size_t p = 0; p < pixels; ++p)
                for (std::size_t e = offsets[p]; e < offsets[p + 1]; ++e)
                    if (isStack(owners[e])) requireShadable(stacks.layersOf(owners[e]), pixelOf(box, p));
        };
        graph.add("shadable",
                  {.reads = {entries.offsets, entries.owners}, .writes = {entries.owners}, .host = ask});
    }

    static glm::dvec2 pixelOf(const PixelBox& box, std::size_t p) {
        const auto width = static_cast<std::size_t>(box.width());
        return {box.x0 + static_cast<int>(p % width) + 0.5, box.y0 + static_cast<int>(p / width) + 0.5};
    }

    static Shade shadeOnHost(const NsaaFrame& frame, const LayerStacks& stacks, const PixelBox& box,
                             const PassGraph& graph, const ShadeEntries& entries, std::size_t e) {
        const glm::dvec2 sample = pixelOf(box, pixelOfEntry(graph, entries.offsets, box, e)) + frame.offset();
        NsaaFrame::Offsets points;
        if (entries.points) {
            const auto ends = graph[*entries.point_ends].read<std::uint32_t>(e + 1);
            const std::size_t begin = e == 0 ? 0 : ends[e - 1];
            points = graph[*entries.points].read<glm::dvec2>(ends[e] - begin, begin * sizeof(glm::dvec2));
        }
        const auto owner = graph[entries.owners].read<std::uint32_t>(1, e * sizeof(std::uint32_t))[0];
        return frame.shade(stacks.layersOf(owner), sample, points);
    }

    static WeightTile readBack(const PassGraph& graph, const WeightEntries& entries, const PixelBox& box) {
        const auto pixels = static_cast<std::size_t>(box.width()) * box.height();
        const auto offsets = graph[entries.offsets].read<std::uint32_t>(pixels + 1);
        const auto owners = graph[entries.owners].read<std::uint32_t>(offsets[pixels]);
        const auto weights = graph[entries.weights].read<FixedWeight>(offsets[pixels]);
        WeightTile tile{box, {offsets.begin(), offsets.end()}, {}, {}};
        for (std::size_t e = 0; e < owners.size(); ++e) tile.entries.push_back({owners[e], weights[e]});
        return tile;
    }

    /// The wall's time, in the proportion of what the passes of weights and the others report.
    void bookStrip(NsaaFrame& frame, const PassGraph& graph) {
        double weighing = 0.0, all = 0.0;
        for (const PassTime& pass : graph.times()) {
            all += pass.seconds;
            if (pass.name.starts_with("weights")) weighing += pass.seconds;
        }
        const double wall = frame.watch.lap();
        const double share = all > 0.0 ? weighing / all : 0.0;
        frame.bookSeconds("weights", wall * share);
        frame.bookSeconds("blend", wall * (1.0 - share));
    }

    Device device_;
    Buffer triangles_, planes_;
    Gather gather_;
    VisibilityPasses visibility_;
    std::optional<WeightPasses> weights_;
    std::optional<std::string> why_not_shaded_, why_not_weighed_;
    std::optional<ShadePass> shade_;
    std::optional<BlendPass> blend_;
    std::uint32_t uses_ = 0;
    std::mutex tiles_mutex_;
    std::vector<WeightTile> tiles_;
    VisibilityReport report_;
    std::size_t handed_entries_ = 0;
};

}  // namespace

PixelReport pixelWeightsVulkan(const MethodInput& input, int x, int y) {
    return withDeviceErrors([&] {
        NsaaFrame frame(input);
        VulkanStages stages(frame);
        return frame.report(stages, x, y);
    });
}

MethodResult runNsaaVulkan(const MethodSpec&, const MethodInput& input) {
    return withDeviceErrors([&] {
        NsaaFrame frame(input);
        VulkanStages stages(frame);
        MethodResult result = frame.render(stages);
        stages.report(result);
        return result;
    });
}

}  // namespace edgewise
