// Where a field's value is 0 on an edge between two corners of different signs.
#pragma once

#include <algorithm>
#include <cmath>

namespace edgewise::sdf {

inline constexpr int kMostRootSteps = 100;

/// Secants by the Illinois rule, halved where that is slow. Coordinates are along the edge.
struct RootBracket {
    double low = 0.0, high = 0.0, at_low = 0.0, at_high = 0.0;  ///< values at the ends
    double root = 0.0, width = 0.0;                             ///< it is looked for no closer
    bool done = true;
    int slow = 0, side = 0;

    static RootBracket between(double low, double high, double at_low, double at_high, double width) {
        RootBracket b{low, high, at_low, at_high, low, width, false, 0, 0};
        if (at_low == 0.0) b.root = low, b.done = true;
        if (at_high == 0.0) b.root = high, b.done = true;
        return b;
    }
    /// Where to ask next.
    double guess() const {
        if (slow >= 3) return 0.5 * (low + high);
        const double x = low - at_low * (high - low) / (at_high - at_low);
        return std::min(std::max(x, low), high);
    }
    void take(double x, double value, bool inside_low) {
        const double before = root, length = high - low;
        root = x;
        const bool to_low = (value < 0.0) == inside_low;
        if (to_low) {
            low = x, at_low = value;
            if (side == 1) at_high *= 0.5;
        } else {
            high = x, at_high = value;
            if (side == -1) at_low *= 0.5;
        }
        side = to_low ? 1 : -1;
        slow = high - low > 0.5 * length && slow < 3 ? slow + 1 : 0;
        done = value == 0.0 || high - low <= width || std::abs(x - before) <= width;
    }
};

}  // namespace edgewise::sdf
