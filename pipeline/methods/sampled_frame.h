// One picture of a sampling method, whatever its samples and the device: projected once, made in bands of
// rows.
#pragma once

#include <atomic>

#include "pipeline/dump_samples.h"
#include "pipeline/methods/pixel_filter.h"
#include "pipeline/methods/stopwatch.h"

namespace edgewise {

class SampledFrame;

/// The stages from visibility to blend, as one device makes them.
class SampledStages {
  public:
    virtual ~SampledStages() = default;

    /// Writes the pixels of a box, of the frame's full width, into the frame's image.
    virtual void render(SampledFrame& frame, const PixelBox& part) = 0;

    /// What a sample takes in memory: the bands' height follows from it.
    virtual double bytesPerSample(const SampledFrame& frame) const;
};

/// Owners at exact positions, on all threads of the CPU; then each pixel is filtered.
class CpuSampledStages : public SampledStages {
  public:
    explicit CpuSampledStages(SampledFrame& frame);
    void render(SampledFrame& frame, const PixelBox& part) override;

    /// At exact positions.
    SampledOwners owners(const SampledFrame& frame, const PixelBox& window);
    std::uint64_t exactDepths() const { return sampler_.exactDepths(); }

  private:
    PointSampler sampler_;
};

/// Members are for the stages.
class SampledFrame {
  public:
    SampledFrame(const MethodInput& in, SamplePattern pattern, SampleWeights weights);
    MethodResult render(SampledStages& stages);

    /// The pixels whose samples a box's pixels look at.
    PixelBox windowOf(const PixelBox& box) const;
    /// Shades and filters a box's pixels on the CPU.
    void filter(const PixelBox& part, SampledOwners sampled);
    /// What the samples of a box's pixels see, for --dump-stages; `sampled` is of the box's window.
    void dumpSamples(const PixelBox& part, const SampledOwners& sampled);
    void bookSeconds(const std::string& name, double seconds);

    const MethodInput& in;
    const SamplePattern pattern;
    const SampleWeights weights;
    MethodResult result;
    Stopwatch watch;
    ScreenPieces pieces;
    ScreenScene screen;
    Shading shading;
    AovPass aov;
    PixelFilter pixels;
    SampleDump dump;
    std::atomic<std::uint64_t> shaded{0};

  private:
    int rowsPerBand(double bytes_per_sample) const;
};

/// The whole picture on the CPU.
MethodResult runSampledCpu(SampledFrame& frame);

}  // namespace edgewise
