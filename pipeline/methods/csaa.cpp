// Coverage-sampled antialiasing as NVIDIA's 32Q (Young 2006): a pixel stores the colours of 8 samples; 24
// more samples say only which of those colours covers them.
//
// An owner weighs its share of the samples that are known. A sample that sees what no colour sample sees
// counts for nothing: its colour was never stored, and any other share would have to guess one. Visibility is
// exact at all 32 samples, and a pixel shades an owner once. Owners are triangles, as fragments are: that a
// neighbour in the same mesh is stored does not help a triangle that is not.
#include "pipeline/methods/csaa.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <functional>

#include "pipeline/methods/pixel_filter.h"
#include "pipeline/methods/registry.h"
#include "pipeline/methods/sampled_frame.h"

namespace edgewise {
namespace {

/// Cells of a 32 x 32 grid of the pixel, in whose centres the samples lie. The method's own positions were
/// never published; to try others, replace this table. The standard locations are on the left and top borders
/// of cells 2, 6, ..., 30, so that these take the other columns and rows, one each. Of such tables this one
/// was found, by annealing from 27 starts, to have the least mean square error of the area of half-planes (64
/// directions x 64 offsets) as the share of the 32 samples inside: root 0.0190 px^2, at most 0.073; the 8
/// alone have 0.057 and 0.222.
struct Cell {
    int column, row;
};
constexpr std::array<Cell, kCoverageSamples> kCoverage{
    {{0, 25},  {1, 4},   {3, 19}, {4, 9},   {5, 0},   {7, 31},  {8, 21},  {9, 12},
     {11, 16}, {12, 28}, {13, 7}, {15, 3},  {16, 15}, {17, 27}, {19, 20}, {20, 1},
     {21, 13}, {23, 23}, {24, 5}, {25, 11}, {27, 24}, {28, 29}, {29, 8},  {31, 17}}};

/// Owners at all samples, less what coverage samples cannot hold.
class CoverageStages : public CpuSampledStages {
  public:
    using CpuSampledStages::CpuSampledStages;

    void render(SampledFrame& frame, const PixelBox& part) override {
        SampledOwners sampled = owners(frame, frame.windowOf(part));
        frame.dumpSamples(part, sampled);
        unknown_ += forgetUnstored(sampled.owner);
        frame.watch.book("visibility", frame.result.stages);
        frame.filter(part, std::move(sampled));
        frame.watch.book("shade", frame.result.stages);
    }

    std::uint64_t unknown() const { return unknown_; }

  private:
    std::uint64_t unknown_ = 0;
};

}  // namespace

SamplePattern coverageSampledPattern() {
    SamplePattern pattern{kColorSamples + kCoverageSamples, 1, standardPattern(kColorSamples).at_px, 32,
                          false};
    for (const Cell& cell : kCoverage)
        pattern.at_px.emplace_back((cell.column + 0.5) / 32, (cell.row + 0.5) / 32);
    return pattern;
}

std::uint64_t forgetUnstored(std::span<Owner> owner) {
    constexpr std::size_t kSamples = kColorSamples + kCoverageSamples;
    using Range = tbb::blocked_range<std::size_t>;
    return tbb::parallel_reduce(
        Range(0, owner.size() / kSamples, 1 << 12), std::uint64_t(0),
        [&](const Range& pixels, std::uint64_t unknown) {
            for (std::size_t i = pixels.begin(); i < pixels.end(); ++i) {
                const auto stored = owner.subspan(i * kSamples, kColorSamples);
                for (Owner& o : owner.subspan(i * kSamples + kColorSamples, kCoverageSamples))
                    if (std::ranges::find(stored, o) == stored.end()) o = kUnknown, ++unknown;
            }
            return unknown;
        },
        std::plus<>());
}

MethodResult runCsaa(const MethodSpec&, const MethodInput& in) {
    SampledFrame frame(in, coverageSampledPattern(), SampleWeights::equal(kColorSamples + kCoverageSamples));
    CoverageStages stages(frame);
    frame.watch.book("gather", frame.result.stages);
    MethodResult result = frame.render(stages);
    result.counts["exact_depths"] = stages.exactDepths();
    result.counts["unknown_samples"] = stages.unknown();
    return result;
}

}  // namespace edgewise
