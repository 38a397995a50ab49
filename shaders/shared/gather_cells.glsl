// GLSL only: the cells of one triangle of gather's buffers. Needs the bindings of gather_buffers.glsl.

struct CellBox {
    ivec2 first;
    ivec2 last;
};

CellBox cellsOf(uint triangle) {
    double ax = triangles[triangle].p_px[0], ay = triangles[triangle].p_px[1];
    double bx = triangles[triangle].p_px[2], by = triangles[triangle].p_px[3];
    double cx = triangles[triangle].p_px[4], cy = triangles[triangle].p_px[5];
    CellSpan x = cellSpan(min(ax, min(bx, cx)), max(ax, max(bx, cx)), grid.x0_px, grid.columns);
    CellSpan y = cellSpan(min(ay, min(by, cy)), max(ay, max(by, cy)), grid.y0_px, grid.rows);
    return CellBox(ivec2(x.first, y.first), ivec2(x.last, y.last));
}

bool meetsCell(uint triangle, ivec2 at) {
    double x0 = double(grid.x0_px + 16 * at.x), y0 = double(grid.y0_px + 16 * at.y);
    return cellOverlap(triangles[triangle].p_px[0], triangles[triangle].p_px[1], triangles[triangle].p_px[2],
                       triangles[triangle].p_px[3], triangles[triangle].p_px[4], triangles[triangle].p_px[5],
                       x0, y0, x0 + 16.0, y0 + 16.0) != kMisses;
}

/// On the target of one pixel a cell.
vec4 clipPosition(dvec2 cell) {
    return vec4(vec2(2.0 * cell / dvec2(grid.columns, grid.rows) - 1.0), 0.0, 1.0);
}
