#include "paper_figures/machine_rates.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>

#include "pipeline/methods/stopwatch.h"

namespace edgewise::figures {
namespace {

constexpr int kChains = 8;
constexpr std::size_t kSteps = 1 << 20;  ///< a chain, a run

/// The chains' sum, so that none can be left out. Lanes are a register of the instruction set.
#define EDGEWISE_MULTIPLY_ADDS(name, lanes, attributes)                       \
    attributes double name(double m, double a) {                              \
        using Lanes = double __attribute__((vector_size(8 * (lanes))));       \
        Lanes x[kChains], factor, summand, sum{};                             \
        for (int i = 0; i < (lanes); ++i) factor[i] = m, summand[i] = a;      \
        for (int c = 0; c < kChains; ++c) x[c] = factor + c;                  \
        for (std::size_t step = 0; step < kSteps; ++step)                     \
            for (int c = 0; c < kChains; ++c) x[c] = x[c] * factor + summand; \
        for (int c = 0; c < kChains; ++c) sum += x[c];                        \
        return sum[0];                                                        \
    }

struct Arithmetic {
    const char* name;
    int lanes;
    double (*run)(double, double);
};

#if defined(__x86_64__)
EDGEWISE_MULTIPLY_ADDS(multiplyAddsSse2, 2, )
EDGEWISE_MULTIPLY_ADDS(multiplyAddsAvx2, 4, __attribute__((target("avx2"))))
EDGEWISE_MULTIPLY_ADDS(multiplyAddsAvx512, 8, __attribute__((target("avx512f"))))

Arithmetic widest() {
    if (__builtin_cpu_supports("avx512f")) return {"avx512", 8, multiplyAddsAvx512};
    if (__builtin_cpu_supports("avx2")) return {"avx2", 4, multiplyAddsAvx2};
    return {"sse2", 2, multiplyAddsSse2};
}
#else
EDGEWISE_MULTIPLY_ADDS(multiplyAdds, 2, )
Arithmetic widest() {
    return {"plain", 2, multiplyAdds};
}
#endif

template <class Work>
double bestSeconds(int runs, const Work& work) {
    double best = 0.0;
    for (int run = 0; run <= runs; ++run) {  // the first one warms
        Stopwatch watch;
        work();
        const double seconds = watch.lap();
        if (run == 1 || (run > 1 && seconds < best)) best = seconds;
    }
    return best;
}

double triadBytesPerSecond(std::size_t doubles, int runs) {
    const auto array = [&] { return std::make_unique_for_overwrite<double[]>(doubles); };
    const auto a = array(), b = array(), c = array();
    const oneapi::tbb::blocked_range<std::size_t> all(0, doubles);
    oneapi::tbb::static_partitioner halves;
    const auto over = [&](const auto& part) { oneapi::tbb::parallel_for(all, part, halves); };
    over([&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) a[i] = b[i] = c[i] = 1.0;
    });
    const double seconds = bestSeconds(runs, [&] {
        over([&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) a[i] = b[i] + 0.5 * c[i];
        });
    });
    return 24.0 * static_cast<double>(doubles) / seconds;
}

double flopsPerSecond(const Arithmetic& arithmetic, int runs) {
    const int threads = oneapi::tbb::this_task_arena::max_concurrency();
    volatile double factor = 0.999, summand = 0.001, sink = 0.0;
    const double m = factor, s = summand;
    const double seconds = bestSeconds(runs, [&] {
        oneapi::tbb::parallel_for(
            0, threads,
            [&](int) {
                if (arithmetic.run(m, s) < 0.0) sink = 1.0;
            },
            oneapi::tbb::static_partitioner());
    });
    return 2.0 * kChains * static_cast<double>(kSteps) * arithmetic.lanes * threads / seconds;
}

}  // namespace

MachineRates measureMachine(std::size_t doubles, int runs) {
    const Arithmetic arithmetic = widest();
    return {triadBytesPerSecond(doubles, runs), flopsPerSecond(arithmetic, runs), arithmetic.name};
}

}  // namespace edgewise::figures
