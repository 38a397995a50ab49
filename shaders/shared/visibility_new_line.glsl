// GLSL only: a clipped line, or a horizontal with its key in in0 and its ends in enter and exit, for the buffers.

GpuLine newLine(LeafLine l, uint mark) {
    GpuLine line;
    uvec2 key = unpackUint2x32(lineKeyOf(l.carrier));
    line.a = pairTo(l.carrier.a);
    line.b = pairTo(l.carrier.b);
    line.A = ddTo(l.carrier.A);
    line.B = ddTo(l.carrier.B);
    line.C = ddTo(l.carrier.C);
    line.y0 = keyTo(l.y0);
    line.y1 = keyTo(l.y1);
    line.in0 = keyTo(l.in0);
    line.in1 = keyTo(l.in1);
    line.enter = pointTo(l.enter);
    line.exit = pointTo(l.exit);
    line.slope = l.slope;
    line.x_low = l.x_low;
    line.x_high = l.x_high;
    line.key_low = key.x;
    line.key_high = key.y;
    line.line_i = l.carrier.ref.i;
    line.line_j = l.carrier.ref.j;
    line.bounds = mark;
    line.span = 0u;
    line.side_before = l.side_before;
    line.side_after = l.side_after;
    return line;
}
