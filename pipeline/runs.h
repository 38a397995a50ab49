// Loops over many items in runs of consecutive ones, on all threads; what comes of them is in the items'
// order.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "pipeline/scan.h"

namespace edgewise {

inline constexpr std::size_t kRunLength = 4096;

inline std::size_t runCount(std::size_t items) {
    return (items + kRunLength - 1) / kRunLength;
}

/// Calls body(run, begin, end).
template <class Body>
void forRuns(std::size_t items, const Body& body) {
    tbb::parallel_for(std::size_t{0}, runCount(items), [&](std::size_t run) {
        body(run, run * kRunLength, std::min((run + 1) * kRunLength, items));
    });
}

/// How many items before each run are `counted`; one entry more than runs, the last is the total.
template <class Counted>
std::vector<std::size_t> countedBefore(std::size_t items, const Counted& counted) {
    std::vector<std::size_t> counts(runCount(items));
    forRuns(items, [&](std::size_t run, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) counts[run] += counted(i) ? 1 : 0;
    });
    return offsetsFromCounts(counts);
}

}  // namespace edgewise
