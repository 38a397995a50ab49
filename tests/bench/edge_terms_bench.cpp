// Nanoseconds a (segment, sample) term whose support meets the segment: with its owners' sums, and the closed
// form alone in every instruction set of this machine.
#include <benchmark/benchmark.h>

#include <bit>
#include <random>
#include <string>

#include "analytic/edge_input.h"
#include "analytic/edge_integral.h"
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

void pixelWeights(benchmark::State& state, const std::string& name, Precision precision) {
    const Prefilter filter = makePrefilter(name, {}, {});
    const glm::dvec2 sample{400.5, 300.5};
    const auto segments = segmentsAround(sample, filter.radius);
    PixelWeights weights(filter, precision);
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

void closedForm(benchmark::State& state, const std::string& name, EdgeTermsFunction edge_terms) {
    const Prefilter filter = makePrefilter(name, {}, {});
    const EdgeKernel kernel(filter);
    std::vector<EdgeInput> inputs;
    for (const MapSegment& s : segmentsAround({400.5, 300.5}, filter.radius))
        inputs.push_back(edgeInput(s.segment, s.line));
    std::vector<EdgePair> pairs;
    for (const EdgeInput& input : inputs)
        for (int i = 0; i < 8; ++i) pairs.push_back({&input, 400.5 + i, 300.5});
    EdgeTerms terms;
    double touched = 0;
    for (auto _ : state)
        for (std::size_t at = 0; at < pairs.size(); at += kMostPairs) {
            const auto count = std::min(pairs.size() - at, std::size_t{kMostPairs});
            edge_terms(kernel.lanes, pairs.data() + at, static_cast<int>(count), terms);
            benchmark::DoNotOptimize(terms);
            touched += std::popcount(terms.touched);
        }
    state.counters["ns_per_term"] =
        benchmark::Counter(touched * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace
}  // namespace edgewise::test

int main(int count, char** arguments) {
    using edgewise::Precision;
    for (const std::string name : {"box", "disk", "tent", "cone", "gaussian", "gaussian-separable", "bspline",
                                   "mitchell", "catmull-rom", "bc:0.5,0.25", "lanczos", "poly:1,-2,1"}) {
        benchmark::RegisterBenchmark(("terms/" + name).c_str(), edgewise::test::pixelWeights, name,
                                     Precision::kFp64);
        benchmark::RegisterBenchmark(("terms/" + name + "/fp32").c_str(), edgewise::test::pixelWeights, name,
                                     Precision::kFp32);
        for (const std::string isa : {"scalar", "sse2", "avx2", "avx512"})
            if (const auto function = edgewise::edgeTermsFor(isa.c_str()))
                benchmark::RegisterBenchmark(("closed_form/" + name + "/" + isa).c_str(),
                                             edgewise::test::closedForm, name, function);
    }
    benchmark::Initialize(&count, arguments);
    benchmark::RunSpecifiedBenchmarks();
}
