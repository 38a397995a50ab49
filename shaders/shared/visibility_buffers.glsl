// GLSL only: the buffers of the visibility stage, and what is read from them.
#include "shared/real_bits.glsl"
#include "shared/double_double.glsl"
#include "shared/layouts.glsl"
#include "shared/visibility_layouts.glsl"
#include "shared/visibility_types.glsl"
#include "shared/fine_point.glsl"
#include "shared/carrier.glsl"
#include "shared/cell_clip.glsl"
#include "shared/local_plane.glsl"
#include "shared/triangle_pair.glsl"
#include "shared/common_part.glsl"
#include "shared/cell_overlap.glsl"

layout(std430, binding = kVisTriangles) readonly buffer Triangles { GpuTriangle triangles[]; };
layout(std430, binding = kVisPlanes) readonly buffer Planes { double planes[]; };
layout(std430, binding = kVisOffsets) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = kVisIds) readonly buffer Ids { uint ids[]; };
layout(std430, binding = kVisSeeThrough) readonly buffer SeeThrough { uint see_through[]; };
layout(std430, binding = kVisCells) buffer Cells { GpuCell cells[]; };
layout(std430, binding = kVisKept) buffer Kept { uint kept[]; };
layout(std430, binding = kVisLeafCells) buffer LeafCells { uint leaf_cells[]; };
layout(std430, binding = kVisStatus) buffer Status { GpuVisibilityStatus status; };
layout(std430, binding = kVisPieces) buffer Pieces { GpuPiece pieces[]; };
layout(std430, binding = kVisRows) buffer Rows { GpuRowPiece rows[]; };
layout(std430, binding = kVisHanded) buffer Handed { uint handed[]; };
layout(std430, binding = kVisTable) buffer Table { uint table[]; };
layout(std430, binding = kVisCrossings) buffer Crossings { GpuCrossing crossings[]; };
layout(std430, binding = kVisLeaves) buffer Leaves { GpuLeaf leaves[]; };
layout(std430, binding = kVisLines) buffer Lines { GpuLine lines[]; };
layout(std430, binding = kVisHorizontals) buffer Horizontals { GpuLine horizontals[]; };
layout(std430, binding = kVisTracks) buffer Tracks { GpuTrack tracks[]; };
layout(std430, binding = kVisEvents) buffer Events { GpuEvent events[]; };
layout(std430, binding = kVisKeys) buffer Keys { GpuKey keys[]; };
layout(std430, binding = kVisItems) buffer Items { GpuKey items[]; };
layout(std430, binding = kVisLocalPlanes) buffer LocalPlanes { GpuLocalPlane local_planes[]; };
layout(std430, binding = kVisWords) buffer Words { uint words[]; };
layout(push_constant) uniform Push { VisibilityPush push; };

ScreenTriangle triangleAt(uint i) {
    ScreenTriangle t;
    t.p_px[0] = dvec2(triangles[i].p_px[0], triangles[i].p_px[1]);
    t.p_px[1] = dvec2(triangles[i].p_px[2], triangles[i].p_px[3]);
    t.p_px[2] = dvec2(triangles[i].p_px[4], triangles[i].p_px[5]);
    t.vertex[0] = triangles[i].vertex[0];
    t.vertex[1] = triangles[i].vertex[1];
    t.vertex[2] = triangles[i].vertex[2];
    t.owner = triangles[i].owner;
    t.plane = triangles[i].plane;
    return t;
}
dvec2 cornerAt(uint i, uint k) { return dvec2(triangles[i].p_px[2 * k], triangles[i].p_px[2 * k + 1]); }
DepthPlane planeAt(uint i) { return DepthPlane(planes[3 * i], planes[3 * i + 1], planes[3 * i + 2]); }
dvec2 anchorPx() { return dvec2(push.anchor_x, push.anchor_y); }
LocalPlane planeOf(uint triangle, dvec2 origin, double reach) {
    uint plane = triangles[triangle].plane;
    return localPlaneOf(planeAt(plane), plane, triangles[triangle].owner, origin - anchorPx(), reach);
}
bool seesThrough(uint owner) {
    return (push.flags & kSomeSeeThrough) != 0 && (see_through[owner >> 5] >> (owner & 31u) & 1u) != 0u;
}
Carrier edgeAt(uint triangle, uint k) {
    return edgeBetween(LineRef(triangle, kFirstEdge + k), cornerAt(triangle, k), cornerAt(triangle, k == 2u ? 0u : k + 1u));
}
Carrier depthLineOf(uint p, uint q) {
    LineRef ref = p < q ? LineRef(p, q) : LineRef(q, p);
    return planesMeet(ref, planeAt(ref.i), planeAt(ref.j), anchorPx());
}
Cell cellOf(GpuCell c) {
    dvec2 low = dvec2(c.min_x, c.min_y);
    return Cell(low, low + dvec2(c.size_px, c.size_px));
}
CellFrame frameOf(GpuCell c) {
    CellFrame frame;
    frame.cell = cellOf(c);
    frame.origin = dvec2(c.origin_x, c.origin_y);
    frame.top = orderKey(border(frame.cell.min.y), frame.origin.y);
    frame.bottom = orderKey(border(frame.cell.max.y), frame.origin.y);
    return frame;
}
LeafLine emptyLine(Carrier carrier) {
    LeafLine line;
    line.carrier = carrier;
    line.y0 = line.y1 = line.in0 = line.in1 = OrderKey(0.0lf, 0.0lf);
    line.side_before = line.side_after = 0;
    line.enter = line.exit = gridPoint(dvec2(0.0lf, 0.0lf));
    line.slope = line.x_low = line.x_high = 0.0lf;
    return line;
}
/// Turns of loops, one more for each loop that is met: also a loop that is passed by takes one.
uint spent = 0u;
uint loopLimit() { return gl_WorkGroupSize.x == 1u ? push.loop_turns : push.loop_turns / kTogether; }
/// After so many an invocation stops, with room for what it has begun.
uint loopBudget() { return loopLimit() / 8u * 3u; }
void countLoops() {
    if (spent >= loopLimit()) atomicAdd(status.overruns, 1u);
}

FineCoordinate sampleRow(int row) { return FineCoordinate(double(row) + 0.5lf, 0.0lf); }

void addRow(uint at, double x, int row, uint owner, uint tag) {
    if (at < status.rows_room) rows[at] = GpuRowPiece(x, row, owner, tag, 0u);
}
