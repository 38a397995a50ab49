// The visible piece of a line that a sweep has begun and not yet ended.
#pragma once

#include <vector>

#include "analytic/cell_clip.h"

namespace edgewise {

struct OpenPiece {
    bool open = false;
    Owner left = kBackground, right = kBackground;
    FinePoint start;

    void begin(Owner new_left, Owner new_right, const FinePoint& at) {
        open = true, left = new_left, right = new_right, start = at;
    }

    /// Appends the piece, if there is one. One of a flat line whose ends rounding moved, or led to a vertex,
    /// may run against the line though it runs down: it is turned, for it is integrated along the line.
    void close(const LeafLine& line, const FinePoint& end, std::vector<SegmentPiece>& out) {
        if (!open) return;
        const Carrier& c = line.carrier;
        const double dx = difference(xOf(end), xOf(start)), dy = difference(yOf(end), yOf(start));
        if (dx * line.slope + dy >= 0.0)
            out.push_back({lineKey(c), c.ref, left, right, start, end});
        else
            out.push_back({lineKey(c), c.ref, right, left, end, start});
        open = false;
    }
};

}  // namespace edgewise
