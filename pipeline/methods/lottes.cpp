// The method `lottes`: frames of LottesFrames, their mean, and how far they are from each other.
#include "pipeline/methods/lottes.h"

#include <fmt/format.h>

#include <filesystem>

#include "pipeline/field_shading.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/methods/temporal_mean.h"
#include "pipeline/write_image.h"

namespace edgewise {
namespace {

LottesSettings settingsOf(const MethodSpec& spec) {
    LottesSettings settings;
    settings.distance = spec.numberOf("distance", settings.distance);
    settings.scale = spec.numberOf("scale", settings.scale);
    settings.grain = spec.numberOf("grain", settings.grain);
    settings.disk = spec.parameter("weights", "gaussian") == "disk";
    settings.spectrum =
        spec.parameter("spectrum", "blue") == "white" ? GrainSpectrum::kWhite : GrainSpectrum::kBlue;
    settings.coverage = spec.parameter("coverage", "on") == "on";
    return settings;
}

/// Deviation times 4 beside black, so that a frame's noise is seen.
void dumpDeviation(const MethodInput& in, const TemporalMean& frames) {
    ImageBuffer picture(in.film.crop);
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        picture.rgba[i] = glm::dvec4(4.0 * frames.deviation(i), 1.0);
    WriteOptions options;
    options.width = in.film.width, options.height = in.film.height;
    std::filesystem::create_directories(*in.options.dump_dir);
    writeImage(*in.options.dump_dir / "temporal_deviation.png", picture, options);
}

}  // namespace

MethodResult traceLottes(const MethodSpec& spec, const MethodInput& in, FieldTracerMaker) {
    requireTree(spec.name, in.scene);
    MethodResult result;
    Stopwatch watch;
    const LottesFrames lottes(in, settingsOf(spec));
    result.setup_seconds = watch.lap();
    TemporalMean mean;
    sdf::RayCounts rays;
    const auto count = static_cast<std::size_t>(in.options.frames);
    in.progress.stage("lottes", count * lottes.window().height());
    for (std::size_t frame = 0; frame < count; ++frame) {
        const std::vector<LottesRay> traced = lottes.trace(frame, rays);
        watch.book("trace", result.stages);
        mean.add(lottes.reconstruct(traced, frame));
        watch.book("reconstruct", result.stages);
    }
    result.image = ImageBuffer(in.film.crop);
    for (std::size_t i = 0; i < result.image.rgba.size(); ++i) result.image.rgba[i] = mean.mean(i);
    countRays(rays, result.counts);
    result.counts["frames"] = count;
    if (count < 2) return result;
    result.counts["temporal_deviation_micro"] = static_cast<std::uint64_t>(1e6 * mean.deviation() + 0.5);
    result.counts["temporal_deviation_of_mean_micro"] =
        static_cast<std::uint64_t>(1e6 * mean.deviationOfMean() + 0.5);
    if (in.options.dump_dir) dumpDeviation(in, mean);
    return result;
}

}  // namespace edgewise
