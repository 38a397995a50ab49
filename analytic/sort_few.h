// Sorting lists that are mostly a few items long.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace edgewise {

/// By insertion up to `few` items.
template <class Item, class Before>
void sortFew(std::vector<Item>& list, std::size_t few, const Before& before) {
    if (list.size() > few) return std::sort(list.begin(), list.end(), before);
    for (std::size_t i = 1; i < list.size(); ++i) {
        if (!before(list[i], list[i - 1])) continue;
        const Item moved = list[i];
        std::size_t at = i;
        for (; at > 0 && before(moved, list[at - 1]); --at) list[at] = list[at - 1];
        list[at] = moved;
    }
}

}  // namespace edgewise
