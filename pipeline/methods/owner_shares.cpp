#include "pipeline/methods/owner_shares.h"

#include <algorithm>

namespace edgewise {

void OwnerShares::clear() {
    first_.assign(1, 0);
    owners_.clear();
    shares_.clear();
}

void OwnerShares::collectRuns(std::span<const Owner> samples) {
    runs_.clear();
    for (int i = 0; i < static_cast<int>(samples.size()); ++i) {
        if (runs_.empty() || runs_.back().owner != samples[i]) runs_.push_back({samples[i], i, i});
        runs_.back().end = i + 1;
    }
    std::ranges::sort(runs_, [](const Run& a, const Run& b) {
        return a.owner != b.owner ? a.owner < b.owner : a.begin < b.begin;
    });
}

/// The owner with the most samples gets what the others leave of the pattern's total, which is exact.
void OwnerShares::add(std::span<const Owner> samples, std::size_t pattern) {
    collectRuns(samples);
    const int reach = weights_.reach();
    const std::size_t first_entry = owners_.size();
    std::size_t largest = first_entry;
    int most = 0;
    groups_.clear();
    for (auto begin = runs_.begin(); begin != runs_.end();) {
        const auto end =
            std::find_if(begin, runs_.end(), [&](const Run& r) { return r.owner != begin->owner; });
        int count = 0;
        for (auto run = begin; run != end; ++run) count += run->end - run->begin;
        if (count > most) most = count, largest = owners_.size();
        owners_.push_back(begin->owner);
        groups_.emplace_back(begin, end);
        begin = end;
    }
    shares_.resize(owners_.size() * reach, 0);
    FixedWeight* const rest = &shares_[largest * reach];
    std::copy_n(weights_.total(pattern), reach, rest);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        if (first_entry + g == largest) continue;
        FixedWeight* const own = &shares_[(first_entry + g) * reach];
        for (const Run& run : groups_[g])
            for (int i = run.begin; i < run.end; ++i) {
                const FixedWeight* const weight = weights_.of(pattern, i);
                for (int k = 0; k < reach; ++k) own[k] += weight[k];
            }
        for (int k = 0; k < reach; ++k) rest[k] -= own[k];
    }
    first_.push_back(owners_.size());
}

}  // namespace edgewise
