// GLSL only: the lines of a leaf in its buffers. One invocation holds one leaf: number `leaf_slot` of those at work.

uint leaf_slot;
GpuLeaf leaf;
CellFrame frame;

uint lineAt(uint i) { return leaf_slot * kLeafLines + i; }
uint horizontalAt(uint i) { return leaf_slot * kLeafHorizontals + i; }
uint eventAt(uint i) { return leaf_slot * kLeafEvents + i; }
uint keyAt(uint i) { return leaf_slot * kLeafKeys + i; }
uint itemAt(uint i) { return leaf_slot * kLeafKeyItems + i; }
uint planeSlot(uint i) { return leaf_slot * kLeafTriangles + i; }
uint wordAt(uint i) { return leaf_slot * kLeafWords + i; }

/// False where this invocation has no leaf to work on.
bool openLeaf() {
    leaf_slot = gl_GlobalInvocationID.x;
    if (leaf_slot >= push.count) return false;
    leaf = leaves[leaf_slot];
    if (leaf.state != kLeafRuns) return false;
    frame = frameOf(cells[leaf.cell]);
    return true;
}

dvec2 pair(double values[2]) { return dvec2(values[0], values[1]); }
OrderKey keyFrom(double values[2]) { return OrderKey(values[0], values[1]); }
FinePoint pointFrom(double values[4]) {
    return FinePoint(dvec2(values[0], values[1]), dvec2(values[2], values[3]));
}
double[4] pointTo(FinePoint p) { return double[4](p.grid.x, p.grid.y, p.rest.x, p.rest.y); }
double[2] keyTo(OrderKey key) { return double[2](key.hi, key.lo); }
double[2] pairTo(dvec2 p) { return double[2](p.x, p.y); }
double[2] ddTo(dd p) { return double[2](p.hi, p.lo); }

Carrier carrierFrom(GpuLine l) {
    Carrier c;
    c.ref = LineRef(l.line_i, l.line_j);
    c.a = pair(l.a);
    c.b = pair(l.b);
    c.A = dd(l.A[0], l.A[1]);
    c.B = dd(l.B[0], l.B[1]);
    c.C = dd(l.C[0], l.C[1]);
    c.anchor = anchorPx();
    return c;
}

LocalPlane localPlaneAt(uint i) {
    GpuLocalPlane p = local_planes[planeSlot(i)];
    return LocalPlane(p.a, p.b, p.c, p.error, p.plane, p.owner);
}

void handBack() {
    leaf.state = kLeafHanded;
    handed[atomicAdd(status.handed, 1u)] = leaf.cell;
}
