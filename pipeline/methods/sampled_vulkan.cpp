// none, ssaa and msaa on a Vulkan device, as an engine would make them: samples rasterized, resolved to the
// owners of each pixel with their weights, shaded and blended there. Where the device sees the owners that
// the CPU sees, the picture has the CPU's bits.
#include "pipeline/methods/sampled_vulkan.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/composite.h"
#include "pipeline/methods/box_halves.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/sampled_frame.h"
#include "pipeline/plan.h"
#include "pipeline/vulkan/blend.h"
#include "pipeline/vulkan/raster.h"
#include "pipeline/vulkan/resolve.h"
#include "pipeline/vulkan/shade.h"

namespace edgewise {
namespace {

using namespace vulkan;

ResolveTable tableOf(const SampledFrame& frame) {
    const SampleWeights& weights = frame.weights;
    ResolveTable table{weights.margin_px, frame.pattern.columns, frame.pattern.rows, {}};
    const std::size_t side = static_cast<std::size_t>(2 * weights.margin_px + 1) * table.columns;
    table.weights.assign(side * weights.rows.size(), kResolveUnreached);
    for (std::size_t row = 0; row < weights.rows.size(); ++row)
        for (int i = 0; i < weights.rows[row].size(); ++i)
            table.weights[row * side + weights.rows[row].first + i] = weights.rows[row].of(i, i + 1);
    return table;
}

ShadeTables tablesOf(const SampledFrame& frame) {
    return makeShadeTables({frame.in.scene, frame.in.camera, frame.in.film, frame.screen, frame.pieces,
                            frame.shading, constantShades(frame.pieces, frame.shading),
                            frame.in.options.background, false});
}

/// Why the samples are filtered and shaded on the CPU; nullopt: on the device.
std::optional<std::string> whyNotFiltered(const SampledFrame& frame, const ResolveTable& table,
                                          const ShadeTables& tables, const DeviceTraits& traits,
                                          const Raster& raster, FilterPlace place) {
    // A program on the CPU takes 1000 cycles a sample for what the CPU's own code finds in runs.
    constexpr std::size_t kFewSamples = 16;
    if (place == FilterPlace::kFastest && !traits.real_gpu && table.weights.size() > kFewSamples)
        return fmt::format("{} is no real GPU, and a pixel's support holds {} samples", traits.name,
                           table.weights.size());
    const bool one_sample = table.weights.size() == 1;  // wherever it is shaded, it is there
    if (frame.in.options.shading.mode != ShadingMode::kClosest && !one_sample)
        return "the device shades at the closest point alone";
    if (frame.aov.weighs()) return "--aov wants the owners of every pixel";
    if (!Resolve::isShortEnough(table, traits))
        return "a pixel's support holds more samples than a device walks over";
    const PixelBox support = frame.windowOf({0, 0, 1, 1});
    if (!raster.fits(support.width(), support.height())) return "a pixel's support is larger than a target";
    return whyNotShaded(tables, traits);
}

class VulkanSampledStages : public SampledStages {
  public:
    VulkanSampledStages(SampledFrame& frame, FilterPlace place)
        : triangles_(bufferOf(device_, "triangles", frame.screen.triangles)),
          planes_(bufferOf(device_, "planes", frame.screen.planes)),
          raster_(device_, frame.screen, frame.pattern) {
        const ResolveTable table = tableOf(frame);
        const ShadeTables tables = tablesOf(frame);
        why_not_filtered_ = whyNotFiltered(frame, table, tables, device_.traits(), raster_, place);
        if (!why_not_filtered_)
            resolve_.emplace(device_, table), shade_.emplace(device_, tables), blend_.emplace(device_);
        warmUp(frame);
        frame.result.device = "vulkan";
        frame.watch.lap();
        frame.result.setup_seconds = setup_.lap();
    }

    void render(SampledFrame& frame, const PixelBox& part) override {
        checkCancelled(frame.in.progress);
        const PixelBox window = frame.windowOf(part);
        if (why_not_filtered_) return filterOnHost(frame, part);
        if (!raster_.fits(window.width(), window.height()) || Resolve::roomFor(part) == 0)
            return renderHalves(frame, part);
        renderOnDevice(frame, part);
    }

    /// Colour, depth and owner of a sample; the host's copies where it filters; else a pixel's counts, colour
    /// and up to four owners, which few pixels exceed.
    double bytesPerSample(const SampledFrame& frame) const override {
        constexpr double kSample = 12.0, kPixel = 56.0, kEntry = 56.0;
        if (why_not_filtered_) return kSample + SampledStages::bytesPerSample(frame);
        return kSample + (kPixel + 4.0 * kEntry) / frame.pattern.size();
    }

    void report(const SampledFrame& frame, MethodResult& result) const {
        const DeviceTraits& traits = device_.traits();
        result.plan.push_back(
            {"visibility", true,
             fmt::format("rasterized on {}: {}", traits.name, describe(raster_.form(), frame.pattern))});
        for (const char* stage : {"weights", "shade", "blend"})
            result.plan.push_back({stage, true,
                                   why_not_filtered_ ? fmt::format("on the CPU: {}", *why_not_filtered_)
                                                     : fmt::format("on {}", traits.name)});
        result.counts["pixels_handed_back"] = handed_pixels_;
        result.counts["entries_handed_back"] = handed_entries_;
        result.notes.push_back(fmt::format(
            "rasterized on {}: corners snapped to 1/{} of a pixel of the target, depths in 32-bit floats",
            traits.name, 1u << traits.subpixel_bits));
        if (why_not_filtered_)
            result.notes.push_back(fmt::format("filtered and shaded on the CPU: {}", *why_not_filtered_));
    }

  private:
    /// Drivers compile at the first draw: one pixel of the picture, made twice.
    void warmUp(SampledFrame& frame) {
        const PixelBox& crop = frame.in.film.crop;
        ImageBuffer none({crop.x0, crop.y0, crop.x0 + 1, crop.y0 + 1});
        std::swap(frame.result.image, none);
        const std::vector<StageTime> stages = frame.result.stages;
        if (why_not_filtered_)
            ownersOf(frame, frame.result.image.box);
        else
            renderOnDevice(frame, frame.result.image.box);
        frame.result.stages = stages;
        frame.shaded = 0, handed_pixels_ = handed_entries_ = 0;
        std::swap(frame.result.image, none);
    }

    void renderHalves(SampledFrame& frame, const PixelBox& part) {
        for (const PixelBox& half : halvesOf(part)) render(frame, half);
    }

    void filterOnHost(SampledFrame& frame, const PixelBox& part) {
        SampledOwners sampled = ownersOf(frame, frame.windowOf(part));
        frame.filter(part, std::move(sampled));
        frame.watch.book("shade", frame.result.stages);
    }

    /// The samples of a window on the host, target by target.
    SampledOwners ownersOf(SampledFrame& frame, const PixelBox& window) {
        SampledOwners out;
        out.owner.resize(static_cast<std::size_t>(window.width()) * window.height() * frame.pattern.size());
        copyOwners(frame, window, window, out);
        return out;
    }

    void copyOwners(SampledFrame& frame, const PixelBox& window, const PixelBox& part, SampledOwners& out) {
        if (!raster_.fits(part.width(), part.height())) {
            for (const PixelBox& half : halvesOf(part)) copyOwners(frame, window, half, out);
            return;
        }
        PassGraph graph(device_);
        const Resource samples =
            raster_.addTo(graph, graph.input("triangles", triangles_), graph.input("planes", planes_), part);
        graph.run({samples});
        const std::size_t from_stride = static_cast<std::size_t>(part.width()) * frame.pattern.columns,
                          stride = static_cast<std::size_t>(window.width()) * frame.pattern.columns,
                          rows = static_cast<std::size_t>(part.height()) * frame.pattern.rows;
        const std::size_t corner =
            static_cast<std::size_t>(part.y0 - window.y0) * frame.pattern.rows * stride +
            static_cast<std::size_t>(part.x0 - window.x0) * frame.pattern.columns;
        const auto from = graph[samples].read<Owner>(from_stride * rows);
        for (std::size_t row = 0; row < rows; ++row)
            std::copy_n(from.begin() + row * from_stride, from_stride,
                        out.owner.begin() + corner + row * stride);
        frame.watch.book("visibility", frame.result.stages);
    }

    void renderOnDevice(SampledFrame& frame, const PixelBox& part) {
        PassGraph graph(device_);
        const Resource samples = raster_.addTo(graph, graph.input("triangles", triangles_),
                                               graph.input("planes", planes_), frame.windowOf(part));
        const Resolve::Resolved lists = resolve_->addTo(graph, samples, part);
        graph.run({lists.status, lists.counts, lists.first, lists.owners, lists.weights, lists.mixed});
        bookPasses(frame, graph);
        const ResolveStatus status = graph[lists.status].read<ResolveStatus>(1)[0];
        if (status.entries > Resolve::roomFor(part)) return renderHalves(frame, part);
        HandedPixels handed;
        if (status.handed_back > 0) {
            handed = resolveOnHost(frame, graph, samples, lists.counts, part);
            frame.watch.book("weights", frame.result.stages);
        }
        const std::size_t entries = Resolve::entriesOf(status) + handed.owners.size();
        if (entries > Resolve::kMostEntries) return renderHalves(frame, part);
        handed_pixels_ += handed.pixels.size(), frame.shaded += entries;
        shadeAndBlend(frame, part, graph, lists, entries, handed);
        frame.in.progress.advance(part.height());
    }

    /// What the device left to the host: pixels with more owners than it holds.
    struct HandedPixels {
        std::vector<std::size_t> pixels;
        std::vector<OwnerWeight> owners;  ///< of all of them, one after the other
        std::vector<std::size_t> ends;
    };

    static HandedPixels resolveOnHost(const SampledFrame& frame, const PassGraph& graph, Resource samples,
                                      Resource counts, const PixelBox& part) {
        const PixelBox window = frame.windowOf(part);
        const std::size_t size =
            static_cast<std::size_t>(window.width()) * window.height() * frame.pattern.size();
        const auto owners = graph[samples].read<Owner>(size);
        const SampleBand band = makeBand(window, frame.pattern, {{owners.begin(), owners.end()}, {}});
        const auto width = static_cast<std::size_t>(part.width());
        const auto count = graph[counts].read<std::uint32_t>(width * part.height());
        const auto made = graph[counts].view<std::uint32_t>(count.size());
        HandedPixels handed;
        for (std::size_t p = 0; p < count.size(); ++p) {
            if (count[p] != kHandedBack) continue;
            const auto list = frame.pixels.ownersOf(band, part.x0 + static_cast<int>(p % width),
                                                    part.y0 + static_cast<int>(p / width));
            made[p] = static_cast<std::uint32_t>(list.size());
            handed.pixels.push_back(p);
            handed.owners.insert(handed.owners.end(), list.begin(), list.end());
            handed.ends.push_back(handed.owners.size());
        }
        return handed;
    }

    static void fillHanded(const PassGraph& graph, const Resolve::Lists& lists, const HandedPixels& handed) {
        const std::size_t last = handed.pixels.back();
        const auto offsets = graph[lists.offsets].read<std::uint32_t>(last + 2);
        const auto owners = graph[lists.owners].view<std::uint32_t>(offsets[last + 1]);
        const auto weights = graph[lists.weights].view<FixedWeight>(offsets[last + 1]);
        std::size_t e = 0;
        for (std::size_t i = 0; i < handed.pixels.size(); ++i)
            for (std::size_t to = offsets[handed.pixels[i]]; e < handed.ends[i]; ++e, ++to)
                owners[to] = handed.owners[e].owner, weights[to] = handed.owners[e].weight;
    }

    void shadeAndBlend(SampledFrame& frame, const PixelBox& part, const PassGraph& before,
                       const Resolve::Resolved& made, std::size_t count, const HandedPixels& handed) {
        PassGraph graph(device_);
        const Resolve::Resolved resolved{
            graph.input("counts", before[made.counts]), graph.input("first", before[made.first]),
            graph.input("owners", before[made.owners]), graph.input("weights", before[made.weights]),
            graph.input("status", before[made.status]), graph.input("mixed", before[made.mixed])};
        const Resolve::Lists lists = resolve_->addOrder(graph, resolved, part, count);
        if (!handed.pixels.empty())
            graph.add("weights on the host",
                      {.reads = {lists.offsets, lists.owners, lists.weights},
                       .writes = {lists.owners, lists.weights},
                       .host = [&](const PassGraph& g) { fillHanded(g, lists, handed); }});
        const auto box = [part] { return part; };
        const ShadeEntries entries{
            graph.input("triangles", triangles_), lists.offsets, lists.owners, {}, {}, {}, {}, box, [count] {
                return count;
            }};
        const Resource shades = shade_->addTo(
            graph, entries, [&](std::size_t e) { return shadeOnHost(frame, part, graph, lists, e); });
        const BlendedPixels out = blend_->addTo(graph, {lists.offsets, lists.weights, shades, box});
        graph.run({out.rgba, out.edge});
        handed_entries_ += shade_->handedBack();
        copyPixels(graph, out, part, frame.result.image);
        bookPasses(frame, graph);
    }

    static Shade shadeOnHost(const SampledFrame& frame, const PixelBox& part, const PassGraph& graph,
                             const Resolve::Lists& lists, std::size_t e) {
        const auto width = static_cast<std::size_t>(part.width());
        const std::size_t p = pixelOfEntry(graph, lists.offsets, part, e);
        const glm::dvec2 sample(part.x0 + static_cast<int>(p % width) + 0.5,
                                part.y0 + static_cast<int>(p / width) + 0.5);
        const Owner owner = graph[lists.owners].read<std::uint32_t>(1, e * sizeof(std::uint32_t))[0];
        return composite(
            std::span(&owner, 1), [&](Owner o) { return frame.shading.closest(o, sample); },
            frame.in.options.background);
    }

    /// The wall's time, in the proportion of what the passes report; a pass's first word is its stage.
    static void bookPasses(SampledFrame& frame, const PassGraph& graph) {
        const double wall = frame.watch.lap();
        double total = 0.0;
        for (const PassTime& pass : graph.times()) total += pass.seconds;
        for (const PassTime& pass : graph.times())
            frame.bookSeconds(pass.name.substr(0, pass.name.find(' ')),
                              total > 0.0 ? wall * pass.seconds / total : 0.0);
    }

    Stopwatch setup_;
    Device device_;
    Buffer triangles_, planes_;
    Raster raster_;
    std::optional<std::string> why_not_filtered_;
    std::optional<Resolve> resolve_;
    std::optional<ShadePass> shade_;
    std::optional<BlendPass> blend_;
    std::size_t handed_pixels_ = 0, handed_entries_ = 0;
};

}  // namespace

MethodResult runSampledVulkan(const MethodInput& in, SamplePattern pattern, SampleWeights weights,
                              FilterPlace place) {
    SampledFrame frame(in, std::move(pattern), std::move(weights));
    if (std::ranges::count(frame.screen.see_through, 1) > 0) {
        MethodResult result = runSampledCpu(frame);
        result.notes.emplace_back("ran on the CPU: the device does not sort what is seen through");
        return result;
    }
    return withDeviceErrors([&] {
        VulkanSampledStages stages(frame, place);
        MethodResult result = frame.render(stages);
        stages.report(frame, result);
        if (frame.dump.active())
            result.notes.emplace_back("what samples see stays on the device: --device cpu dumps it");
        return result;
    });
}

MethodResult runNoneVulkan(const MethodSpec&, const MethodInput& in) {
    return runSampledVulkan(in, latticePattern(1), SampleWeights::equal(1));
}

MethodResult runSsaaVulkan(const MethodSpec& spec, const MethodInput& in) {
    return runSampledVulkan(in, latticePattern(*spec.number), SampleWeights(in.filter, *spec.number));
}

MethodResult runMsaaVulkan(const MethodSpec& spec, const MethodInput& in) {
    return runSampledVulkan(in, standardPattern(*spec.number), SampleWeights::equal(*spec.number));
}

}  // namespace edgewise
