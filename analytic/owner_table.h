// Weights of the owners around eight samples: a small open-addressing table, allocation-free once it has
// grown.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "analytic/screen_triangle.h"

namespace edgewise {

class OwnerTable {
  public:
    static constexpr int kLanes = 8;
    struct Row {
        Owner owner;
        std::array<std::int64_t, kLanes> weight;
    };

    void clear() {
        rows_.clear();
        std::fill(slots_.begin(), slots_.end(), kEmpty);
    }

    /// The owner's row, made of zeros when it is new; valid until the next call.
    Row& row(Owner owner) {
        if (slots_.size() < 2 * (rows_.size() + 1)) grow();
        std::uint32_t& slot = slots_[find(owner)];
        if (slot == kEmpty) {
            slot = static_cast<std::uint32_t>(rows_.size());
            rows_.push_back({owner, {}});
        }
        return rows_[slot];
    }

    /// Rows by ascending owner; the table is to be cleared before the next row().
    const std::vector<Row>& sorted() {
        std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.owner < b.owner; });
        return rows_;
    }

  private:
    static constexpr std::uint32_t kEmpty = 0xffffffffu;

    std::size_t find(Owner owner) const {
        const std::size_t last = slots_.size() - 1;
        std::size_t at = (owner * 0x9e3779b1u >> 8) & last;
        while (slots_[at] != kEmpty && rows_[slots_[at]].owner != owner) at = (at + 1) & last;
        return at;
    }

    void grow() {
        slots_.assign(std::max<std::size_t>(16, 2 * slots_.size()), kEmpty);
        for (std::size_t i = 0; i < rows_.size(); ++i)
            slots_[find(rows_[i].owner)] = static_cast<std::uint32_t>(i);
    }

    std::vector<Row> rows_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace edgewise
