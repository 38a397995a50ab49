// The method `lottes`: frames of LottesFrames, their mean, and how far they are from each other.
#include "pipeline/methods/lottes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "pipeline/field_shading.h"
#include "pipeline/methods/field_aov.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/stopwatch.h"
#include "pipeline/methods/temporal_mean.h"
#include "pipeline/write_image.h"

namespace edgewise {
namespace {

LottesSettings settingsOf(const MethodSpec& spec) {
    LottesSettings settings;
    settings.distance = spec.numberOf("distance");
    settings.scale = spec.numberOf("scale");
    settings.grain = spec.numberOf("grain");
    settings.disk = spec.parameter("weights") == "disk";
    settings.spectrum = spec.parameter("spectrum") == "white" ? GrainSpectrum::kWhite : GrainSpectrum::kBlue;
    settings.coverage = spec.parameter("coverage") == "on";
    return settings;
}

/// What a pixel takes while its band is made: ray, frame, three sums, spread.
constexpr double kBytesPerPixel = sizeof(LottesRay) + 4 * sizeof(glm::dvec4) + sizeof(ColorSpread);

/// A picture in bands of rows, each of all frames.
class LottesPicture {
  public:
    LottesPicture(const MethodInput& in, const LottesSettings& settings) : in_(in), settings_(settings) {
        result_.image = ImageBuffer(in.film.crop);
        if (in.options.dump_dir) deviation_ = ImageBuffer(in.film.crop);
    }

    MethodResult made(const FieldTracerMaker& make) {
        const PixelBox& crop = in_.film.crop;
        in_.progress.stage("lottes", static_cast<std::size_t>(crop.height()));
        const double fit =
            0.5 * 0x1p20 * static_cast<double>(in_.options.memory_mib) / (kBytesPerPixel * crop.width());
        const int rows = static_cast<int>(std::clamp(fit, 1.0, static_cast<double>(crop.height())));
        for (int y = crop.y0; y < crop.y1; y += rows)
            band({crop.x0, y, crop.x1, std::min(y + rows, crop.y1)});
        if (!in_.options.aovs.empty()) {
            traceFieldAovs(in_, make, result_.image);
            watch_.book("aov", result_.stages);
        }
        countRays(rays_, result_.counts);
        countFrames();
        return std::move(result_);
    }

  private:
    void band(const PixelBox& part) {
        Film film = in_.film;
        film.crop = part;
        const MethodInput in{in_.scene, in_.camera, film, in_.filter, in_.options, in_.progress};
        const LottesFrames lottes(in, settings_);
        result_.setup_seconds += watch_.lap();
        TemporalMean mean;
        std::vector<ColorSpread> spreads(static_cast<std::size_t>(part.width()) * part.height());
        for (int frame = 0; frame < in_.options.frames; ++frame) {
            const std::vector<LottesRay> traced = lottes.trace(frame, rays_);
            watch_.book("trace", result_.stages);
            mean.add(lottes.reconstruct(traced, frame));
            lottes.spread(traced, spreads);
            watch_.book("reconstruct", result_.stages);
        }
        take(part, mean, spreads);
        in_.progress.advance(static_cast<std::size_t>(part.height()));
    }

    void take(const PixelBox& part, const TemporalMean& mean, const std::vector<ColorSpread>& spreads) {
        const std::size_t first = result_.image.index(part.x0, part.y0);
        for (std::size_t i = 0; i < spreads.size(); ++i) {
            result_.image.rgba[first + i] = mean.mean(i);
            result_.image.edge[first + i] = spreads[i].edge();
            // Times 4, so that a frame's noise is seen.
            if (in_.options.dump_dir) deviation_.rgba[first + i] = glm::dvec4(4.0 * mean.deviation(i), 1.0);
        }
        const double pixels = static_cast<double>(spreads.size());
        squares_ += pixels * mean.deviation() * mean.deviation();
        squares_of_mean_ += pixels * mean.deviationOfMean() * mean.deviationOfMean();
    }

    void countFrames() {
        result_.counts["frames"] = static_cast<std::uint64_t>(in_.options.frames);
        if (in_.options.frames < 2) return;
        const double pixels = static_cast<double>(result_.image.rgba.size());
        const auto micro = [&](double squares) {
            return static_cast<std::uint64_t>(1e6 * std::sqrt(squares / pixels) + 0.5);
        };
        result_.counts["temporal_deviation_micro"] = micro(squares_);
        result_.counts["temporal_deviation_of_mean_micro"] = micro(squares_of_mean_);
        if (!in_.options.dump_dir) return;
        WriteOptions options;
        options.width = in_.film.width, options.height = in_.film.height;
        std::filesystem::create_directories(*in_.options.dump_dir);
        writeImage(*in_.options.dump_dir / "temporal_deviation.png", deviation_, options);
    }

    const MethodInput& in_;
    const LottesSettings settings_;
    MethodResult result_;
    ImageBuffer deviation_;  ///< for --dump-stages
    Stopwatch watch_;
    sdf::RayCounts rays_;
    double squares_ = 0.0, squares_of_mean_ = 0.0;
};

}  // namespace

MethodResult traceLottes(const MethodSpec& spec, const MethodInput& in, const FieldTracerMaker& make) {
    requireTree(spec.name, in.scene);
    return LottesPicture(in, settingsOf(spec)).made(make);
}

}  // namespace edgewise
