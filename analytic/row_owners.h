// The owners along the sample rows of a visible map.
#pragma once

#include <algorithm>

#include "analytic/visible_segment.h"

namespace edgewise {

/// The owners just right of (x_px + k, row + 0.5), k = 0 .. count - 1, passed to store(k, owner). The row is
/// in the map's window.
template <class Store>
void ownersAlongRow(const VisibleMap& map, int row, double x_px, int count, Store&& store) {
    const auto index = static_cast<std::size_t>(row - map.row_begin);
    const auto begin = map.rows.begin() + static_cast<std::ptrdiff_t>(map.row_offset[index]);
    const auto end = map.rows.begin() + static_cast<std::ptrdiff_t>(map.row_offset[index + 1]);
    auto next =
        std::upper_bound(begin, end, x_px, [](double x, const RowOwner& entry) { return x < entry.x_px; });
    for (int k = 0; k < count; ++k) {
        while (next != end && next->x_px <= x_px + k) ++next;
        store(k, next == begin ? begin->owner : std::prev(next)->owner);
    }
}

inline Owner ownerOnRow(const VisibleMap& map, int row, double x_px) {
    Owner found = kBackground;
    ownersAlongRow(map, row, x_px, 1, [&](int, Owner owner) { found = owner; });
    return found;
}

}  // namespace edgewise
