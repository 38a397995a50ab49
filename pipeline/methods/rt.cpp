// N Owen-scrambled Sobol samples a pixel by primary rays, shared by the pixels whose filter reaches them.
#include <fmt/format.h>

#include "pipeline/methods/pattern_filter.h"
#include "pipeline/methods/ray_scene.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/sampled_frame.h"

namespace edgewise {
namespace {

/// Building the trees and tables is set-up.
class RayStages : public SampledStages {
  public:
    RayStages(SampledFrame& frame, int samples)
        : patterns_(sobolPatterns(samples, patternCount(frame.in.filter, samples), frame.in.options.seed)),
          weights_(frame.in.filter, patterns_),
          scene_(frame.screen, frame.in.film, frame.in.camera.camera.perspective, frame.weights.margin_px),
          filter_(frame.in, frame.shading, frame.aov, patterns_, weights_) {
        frame.result.counts["packet_rays"] = scene_.packetSize();
        frame.result.setup_seconds = frame.watch.lap();
    }

    void render(SampledFrame& frame, const PixelBox& part) override {
        const PixelBox window = frame.windowOf(part);
        const SampledOwners sampled = scene_.trace(window, patterns_);
        frame.watch.book("visibility", frame.result.stages);
        if (frame.dump.active()) dumpSamples(frame, part, sampled);
        filter_.filter(part, window, sampled, frame.result.image, frame.shaded);
        frame.watch.book("shade", frame.result.stages);
    }

    double bytesPerSample(const SampledFrame&) const override { return sizeof(Owner); }

  private:
    void dumpSamples(SampledFrame& frame, const PixelBox& part, const SampledOwners& sampled) const {
        const PixelBox window = frame.windowOf(part);
        const auto count = static_cast<std::size_t>(patterns_.samples);
        for (int y = part.y0; y < part.y1; ++y)
            for (int x = part.x0; x < part.x1; ++x) {
                const std::size_t pixel =
                    static_cast<std::size_t>(y - window.y0) * window.width() + (x - window.x0);
                frame.dump.pixel(x, y, patterns_.pattern(patterns_.patternOf(x, y)),
                                 std::span(sampled.owner).subspan(pixel * count, count), sampled.stacks);
            }
    }

    PixelPatterns patterns_;
    PatternWeights weights_;
    RayScene scene_;
    PatternFilter filter_;
};

}  // namespace

MethodResult runRt(const MethodSpec& spec, const MethodInput& in) {
    const int samples = *spec.number;
    // The frame asks a pattern for its size alone: the stages have their own for each pixel.
    SampledFrame frame(in, {samples, 1, {}, 1, false},
                       SampleWeights::none(PatternWeights::marginPx(in.filter)));
    RayStages stages(frame, samples);
    return frame.render(stages);
}

}  // namespace edgewise
