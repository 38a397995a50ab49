// Nanoseconds a (segment, sample) term. items_per_second counts terms whose support meets the segment.
#include <benchmark/benchmark.h>

#include <random>
#include <string>

#include "tests/analytic/triangle_map.h"

namespace edgewise::test {
namespace {

/// Segments about as long as a pixel, around eight samples.
std::vector<MapSegment> segmentsAround(glm::dvec2 sample, double radius) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> x(-radius, 7 + radius), y(-radius, radius), turn(-1, 1);
    std::vector<MapSegment> segments;
    const auto grid = [](double v) { return std::round(v * 0x1p32) * 0x1p-32; };
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const glm::dvec2 a = sample + glm::dvec2(grid(x(random)), grid(y(random)));
        segments.push_back(segmentBetween(a, a + glm::dvec2(grid(turn(random)), grid(turn(random))), i));
    }
    return segments;
}

void pixelWeights(benchmark::State& state, const std::string& name) {
    const Prefilter filter = makePrefilter(name, {}, {});
    const glm::dvec2 sample{400.5, 300.5};
    const auto segments = segmentsAround(sample, filter.radius);
    PixelWeights weights(filter);
    std::vector<OwnerWeight> out;
    std::size_t offset[9];
    const Owner base[8] = {};
    for (auto _ : state) {
        weights.begin(sample, 8);
        for (const MapSegment& s : segments)
            weights.add(s.segment, s.line, s.segment.line % 50, s.segment.line % 50 + 1);
        out.clear();
        weights.finish(base, out, offset);
        benchmark::DoNotOptimize(out.data());
    }
    state.counters["ns_per_term"] =
        benchmark::Counter(static_cast<double>(weights.terms()) * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["terms_per_call"] =
        static_cast<double>(weights.terms()) / static_cast<double>(state.iterations() * 1000);
}

}  // namespace
}  // namespace edgewise::test

int main(int count, char** arguments) {
    for (const char* name : {"box", "disk", "tent", "cone", "gaussian", "gaussian-separable", "bspline",
                             "mitchell", "lanczos", "poly:1,-2,1"})
        benchmark::RegisterBenchmark(name, edgewise::test::pixelWeights, std::string(name));
    benchmark::Initialize(&count, arguments);
    benchmark::RunSpecifiedBenchmarks();
}
