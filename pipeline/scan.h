// Exclusive prefix sums: counts become offsets.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace edgewise {

/// offsets[i] = counts[0] + ... + counts[i - 1]; one entry more than counts, the last is the total.
template <class Count>
std::vector<std::size_t> offsetsFromCounts(const std::vector<Count>& counts) {
    std::vector<std::size_t> offsets(counts.size() + 1, 0);
    std::transform_inclusive_scan(counts.begin(), counts.end(), offsets.begin() + 1, std::plus<>(),
                                  [](const Count& c) { return static_cast<std::size_t>(c); });
    return offsets;
}

/// Lists of ids, one list a cell: ids[offsets[c]] .. ids[offsets[c + 1]].
struct IdLists {
    std::vector<std::size_t> offsets;
    std::vector<std::uint32_t> ids;
};

}  // namespace edgewise
