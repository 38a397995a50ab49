#version 460
// Conservative rasterization after the paper: the triangle, in units of cells, is thickened by scaling it about
// the centre of its incircle; the fragment shader clips it to the box of its cells (NSAA section 3.1).
//     p' = c + (p - c) (r + h)/r        moves every edge outwards by h
// A cell that the triangle meets has its centre within half a diagonal of it, so with h = 0.7072 every such
// centre is inside. h is larger by kMarginCells for what the rasterizer rounds: corners of at most kFarCells
// lose 2^-22 of that to float and to clipping, and 2^-9 to a snapping of 1/256 px, in each coordinate. Where
// a corner would go farther, as a sliver's does, the box itself is drawn.
#include "shared/gather_buffers.glsl"
#include "shared/gather_cells.glsl"
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;
layout(location = 0) flat in uint triangle_in[];
layout(location = 0) flat out uint triangle;
layout(location = 1) flat out ivec4 cells;

layout(constant_id = 1) const bool kOverestimates = false;  // the device's own rasterizer is conservative
const double kHalfDiagonal = 0.7072lf;
const double kMarginCells = 0.015625lf;
const double kFarCells = 4096.0lf;

void emit(dvec2 corner, uint id, ivec4 box) {
    triangle = id, cells = box;
    gl_Position = clipPosition(corner);
    EmitVertex();
}

void main() {
    uint id = triangle_in[0];
    CellBox found = cellsOf(id);
    ivec4 box = ivec4(found.first, found.last);
    dvec2 origin = dvec2(grid.x0_px, grid.y0_px);
    dvec2 a = (dvec2(triangles[id].p_px[0], triangles[id].p_px[1]) - origin) / 16.0;
    dvec2 b = (dvec2(triangles[id].p_px[2], triangles[id].p_px[3]) - origin) / 16.0;
    dvec2 c = (dvec2(triangles[id].p_px[4], triangles[id].p_px[5]) - origin) / 16.0;
    double la = length(c - b), lb = length(a - c), lc = length(b - a), around = la + lb + lc;
    dvec2 u = b - a, v = c - a;
    double r = (u.x * v.y - u.y * v.x) / around;
    double h = (kOverestimates ? 0.0 : kHalfDiagonal) + kMarginCells;
    dvec2 centre = (la * a + lb * b + lc * c) / around;
    double scale = (r + h) / r;
    dvec2 fa = centre + (a - centre) * scale, fb = centre + (b - centre) * scale,
          fc = centre + (c - centre) * scale;
    dvec2 reach = max(max(abs(fa), abs(fb)), abs(fc));
    if (r > kMarginCells && max(reach.x, reach.y) < kFarCells) {
        emit(fa, id, box), emit(fb, id, box), emit(fc, id, box);
    } else {
        emit(dvec2(box.xy), id, box), emit(dvec2(box.z + 1, box.y), id, box);
        emit(dvec2(box.x, box.w + 1), id, box), emit(dvec2(box.zw + 1), id, box);
    }
    EndPrimitive();
}
