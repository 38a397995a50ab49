// Names of lines for sorting: equal for the same line wherever it was met. analytic/carrier.h: lineKey.

EDGEWISE_FN uint64_t mixed(uint64_t h, uint64_t v) {
    uint64_t m = (h ^ v) * mixFactor();
    return m ^ (m >> 29);
}
/// The cell of 16 px that holds a point, row by row, in the upper 34 bits.
EDGEWISE_FN uint64_t cellBits(real px) {
    return uint64_t(int(floor(px * EDGEWISE_REAL(0.0625))) + 0x10000) & uint64_t(0x1ffff);
}
EDGEWISE_FN uint64_t nearby(real x, real y) {
    return cellBits(y) << 47 | cellBits(x) << 30;
}
EDGEWISE_FN uint64_t lineKeyOf(EDGEWISE_IN(Carrier) line) {
    if (!isEdge(line)) return mixed(mixed(uint64_t(1), uint64_t(line.ref.i)), uint64_t(line.ref.j));
    uint64_t h = mixed(uint64_t(2), bitsOf(line.a.y + EDGEWISE_REAL(0.0)));
    if (line.a.y == line.b.y) return h;
    h = mixed(h, bitsOf(line.a.x + EDGEWISE_REAL(0.0)));
    h = mixed(h, bitsOf(line.b.y + EDGEWISE_REAL(0.0)));
    return nearby(line.a.x, line.a.y) | mixed(h, bitsOf(line.b.x + EDGEWISE_REAL(0.0))) >> 30;
}
EDGEWISE_FN uint64_t closingKeyOf(FineCoordinate y) {
    return mixed(mixed(uint64_t(3), bitsOf(y.grid + EDGEWISE_REAL(0.0))), bitsOf(y.rest + EDGEWISE_REAL(0.0)));
}
