// Weights of the owners around one sample, which mostly are few.
#pragma once

#include <vector>

#include "analytic/owner_weight.h"
#include "analytic/sort_few.h"

namespace edgewise {

class SampleOwners {
  public:
    void clear() { rows_.clear(); }
    bool empty() const { return rows_.empty(); }

    /// Sums may leave the range on the way: they come back, modulo 2^64. An owner that was met long ago gets
    /// a second row, so that a crowded sample costs no search through all of its owners.
    void add(Owner owner, FixedWeight weight) {
        const std::size_t oldest = rows_.size() > kSearched ? rows_.size() - kSearched : 0;
        for (std::size_t i = rows_.size(); i > oldest; --i)
            if (rows_[i - 1].owner == owner) return wrappingAdd(rows_[i - 1].weight, weight);
        rows_.push_back({owner, weight});
    }

    /// Owners in ascending order, without those of weight 0; to be cleared before the next add().
    void appendTo(std::vector<OwnerWeight>& out) {
        sortFew(rows_, kSearched,
                [](const OwnerWeight& a, const OwnerWeight& b) { return a.owner < b.owner; });
        for (std::size_t i = 0; i < rows_.size();) {
            OwnerWeight sum = rows_[i];
            for (++i; i < rows_.size() && rows_[i].owner == sum.owner; ++i)
                wrappingAdd(sum.weight, rows_[i].weight);
            if (sum.weight != 0) out.push_back(sum);
        }
    }

  private:
    static constexpr std::size_t kSearched = 32;

    static void wrappingAdd(FixedWeight& sum, FixedWeight term) {
        sum = static_cast<FixedWeight>(static_cast<std::uint64_t>(sum) + static_cast<std::uint64_t>(term));
    }

    std::vector<OwnerWeight> rows_;
};

}  // namespace edgewise
