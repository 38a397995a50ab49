#include "pipeline/methods/sampled_frame.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "pipeline/methods/aov_report.h"

namespace edgewise {
namespace {

PixelBox grown(const PixelBox& box, int margin) {
    return {box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
}

/// The owners of N passes, one a sample of the pixel, side by side.
SampledOwners interleaved(std::vector<SampledOwners> passes) {
    std::vector<const LayerStacks*> parts;
    for (const SampledOwners& pass : passes) parts.push_back(&pass.stacks);
    SampledOwners out;
    std::vector<std::vector<Owner>> names;
    out.stacks = LayerStacks::joined(parts, names);
    const std::size_t count = passes.size(), pixels = passes.front().owner.size();
    out.owner.resize(count * pixels);
    const auto named = [&](std::size_t s, Owner owner) {
        return isStack(owner) ? names[s][owner - kFirstStack] : owner;
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, 1 << 14), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            for (std::size_t s = 0; s < count; ++s) out.owner[i * count + s] = named(s, passes[s].owner[i]);
    });
    return out;
}

}  // namespace

double SampledStages::bytesPerSample(const SampledFrame& frame) const {
    const bool hit = frame.in.options.shading.mode == ShadingMode::kHit;
    return sizeof(Owner) + sizeof(std::uint32_t) + (hit ? sizeof(Shade) : 0);
}

CpuSampledStages::CpuSampledStages(SampledFrame& frame)
    : sampler_(frame.screen, frame.windowOf(frame.in.film.crop),
               frame.pattern.lattice ? frame.pattern.columns : 1) {}

SampledOwners CpuSampledStages::owners(const SampledFrame& frame, const PixelBox& window) {
    if (frame.pattern.lattice) return sampler_.sample(window);
    std::vector<SampledOwners> passes;
    for (const glm::dvec2& at : frame.pattern.at_px) {
        checkCancelled(frame.in.progress);
        passes.push_back(sampler_.sample(window, at - 0.5));
    }
    return interleaved(std::move(passes));
}

void CpuSampledStages::render(SampledFrame& frame, const PixelBox& part) {
    SampledOwners sampled = owners(frame, frame.windowOf(part));
    frame.watch.book("visibility", frame.result.stages);
    frame.dumpSamples(part, sampled);
    frame.filter(part, std::move(sampled));
    frame.watch.book("shade", frame.result.stages);
}

SampledFrame::SampledFrame(const MethodInput& input, SamplePattern samples, SampleWeights table)
    : in(input),
      pattern(std::move(samples)),
      weights(std::move(table)),
      screen(project(in.scene, in.camera, in.film, pieces, in.progress)),
      shading(in.scene, in.camera, in.film, screen, pieces),
      aov(in.options.aovs, in.scene, in.camera, in.film, screen, pieces, shading),
      pixels(in, shading, aov, weights, pattern),
      dump(in.options.dump_dir, in.film.crop, screen) {
    watch.book("project", result.stages);
    checkCancelled(in.progress);
}

MethodResult SampledFrame::render(SampledStages& stages) {
    const PixelBox& crop = in.film.crop;
    result.image = ImageBuffer(crop);
    aov.begin(result.image);
    aov.samplePoints(in.progress, result.image);
    if (aov.pointSamples()) watch.book("aov", result.stages);
    const int rows = rowsPerBand(stages.bytesPerSample(*this));
    std::uint64_t samples = 0;
    in.progress.stage("samples", crop.height());
    for (int y = crop.y0; y < crop.y1; y += rows) {
        const PixelBox part{crop.x0, y, crop.x1, std::min(y + rows, crop.y1)}, window = windowOf(part);
        stages.render(*this, part);
        samples += static_cast<std::uint64_t>(window.width()) * window.height() * pattern.size();
        checkCancelled(in.progress);
    }
    dump.finish();
    result.counts["triangles"] = in.scene.triangle_count;
    result.counts["pieces"] = screen.triangles.size();
    result.counts["samples"] = samples;
    result.counts["shaded"] = shaded;
    reportAovs(aov, result);
    return std::move(result);
}

PixelBox SampledFrame::windowOf(const PixelBox& box) const {
    return grown(box, weights.margin_px);
}

void SampledFrame::filter(const PixelBox& part, SampledOwners sampled) {
    SampleBand band = makeBand(windowOf(part), pattern, std::move(sampled));
    if (in.options.shading.mode == ShadingMode::kHit) pixels.shadeSamples(band);
    tbb::parallel_for(part.y0, part.y1, [&](int row) {
        if (in.progress.cancelled()) return;
        pixels.filterRow(band, row, part.x0, part.x1, result.image, shaded);
        in.progress.advance(1);
    });
}

void SampledFrame::dumpSamples(const PixelBox& part, const SampledOwners& sampled) {
    if (!dump.active()) return;
    const PixelBox window = windowOf(part);
    const auto columns = static_cast<std::size_t>(pattern.columns),
               rows = static_cast<std::size_t>(pattern.rows);
    const std::size_t stride = columns * static_cast<std::size_t>(window.width());
    std::vector<Owner> owners(columns * rows);
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x) {
            const Owner* first = &sampled.owner[static_cast<std::size_t>(y - window.y0) * rows * stride +
                                                static_cast<std::size_t>(x - window.x0) * columns];
            for (std::size_t row = 0; row < rows; ++row)
                std::copy_n(first + row * stride, columns, &owners[row * columns]);
            dump.pixel(x, y, pattern.at_px, owners, sampled.stacks);
        }
}

void SampledFrame::bookSeconds(const std::string& name, double seconds) {
    for (StageTime& known : result.stages)
        if (known.name == name) return void(known.seconds += seconds);
    result.stages.push_back({name, seconds});
}

/// As many as have their samples in half the memory; at least one.
int SampledFrame::rowsPerBand(double bytes_per_sample) const {
    const PixelBox& crop = in.film.crop;
    const double row_bytes = bytes_per_sample * pattern.size() * (crop.width() + 2.0 * weights.margin_px);
    const double rows = 0.5 * 0x1p20 * double(in.options.memory_mib) / row_bytes - 2.0 * weights.margin_px;
    return static_cast<int>(std::clamp(rows, 1.0, double(crop.height())));
}

MethodResult runSampledCpu(SampledFrame& frame) {
    CpuSampledStages stages(frame);
    frame.watch.book("gather", frame.result.stages);
    MethodResult result = frame.render(stages);
    result.counts["exact_depths"] = stages.exactDepths();
    return result;
}

}  // namespace edgewise
