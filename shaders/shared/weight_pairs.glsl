// GLSL only: which pixels of a tile a segment may touch.
#include "shared/segment_tiles.glsl"

/// A segment as the tile sees it, the picture's offset taken off.
struct SeenSegment {
    double ax, ay, bx, by;
};
SeenSegment seenFrom(GpuSegment s, double offset_x, double offset_y) {
    return SeenSegment((s.a_grid[0] + s.a_rest[0]) - offset_x, (s.a_grid[1] + s.a_rest[1]) - offset_y,
                       (s.b_grid[0] + s.b_rest[0]) - offset_x, (s.b_grid[1] + s.b_rest[1]) - offset_y);
}

/// Those of one row of the tile at (x0, y0), places from 0 on.
TileSpan pixelsNear(SeenSegment s, int x0, int y0, int row, double reach) {
    double y = double(y0 + row) + 0.5lf;
    if (s.ay > y + reach || s.by < y - reach) return TileSpan(0, -1);
    Span x = spanWithin(s.ax, s.ay, s.bx, s.by, y - reach, y + reach);
    double left = double(x0) + 0.5lf;
    double first = ceil((x.low - reach) - left), last = floor((x.high + reach) - left);
    return TileSpan(int(clamp(first, 0.0lf, double(kTilePx))), int(clamp(last, -1.0lf, double(kTilePx - 1))));
}

uint pairsNear(SeenSegment s, int x0, int y0, double reach) {
    uint pairs = 0u;
    for (int row = 0; row < kTilePx; ++row) {
        TileSpan columns = pixelsNear(s, x0, y0, row, reach);
        pairs += uint(max(columns.last - columns.first + 1, 0));
    }
    return pairs;
}
