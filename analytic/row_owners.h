// The owners along the sample rows of a visible map.
#pragma once

#include <algorithm>

#include "analytic/visible_segment.h"

namespace edgewise {

/// The side of an abscissa on which an owner is asked for: they differ where a segment passes.
enum class Side { kLeft, kRight };

/// The owners beside (x_px + k, row + 0.5), k = 0 .. count - 1, passed to store(k, owner). The row is in the map's window.
template <class Store>
void ownersAlongRow(const VisibleMap& map, int row, double x_px, int count, Side side, Store&& store) {
    const auto index = static_cast<std::size_t>(row - map.row_begin);
    const auto begin = map.rows.begin() + static_cast<std::ptrdiff_t>(map.row_offset[index]);
    const auto end = map.rows.begin() + static_cast<std::ptrdiff_t>(map.row_offset[index + 1]);
    const auto starts = [side](const RowOwner& entry, double at) {
        return entry.x_px < at || (entry.x_px == at && side == Side::kRight);
    };
    auto next = std::partition_point(begin, end, [&](const RowOwner& entry) { return starts(entry, x_px); });
    for (int k = 0; k < count; ++k) {
        while (next != end && starts(*next, x_px + k)) ++next;
        store(k, next == begin ? begin->owner : std::prev(next)->owner);
    }
}

inline Owner ownerOnRow(const VisibleMap& map, int row, double x_px, Side side) {
    Owner found = kBackground;
    ownersAlongRow(map, row, x_px, 1, side, [&](int, Owner owner) { found = owner; });
    return found;
}

}  // namespace edgewise
