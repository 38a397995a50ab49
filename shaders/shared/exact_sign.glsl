// The sign of an exact sum of up to 18 doubles: analytic/expansion.h. Exact while nothing overflows and no partial
// product falls below 2^-960.

double expansion_part[18];
int expansion_size;

void expansionAdd(double value) {
    int kept_parts = 0;
    for (int i = 0; i < expansion_size; ++i) {
        dd sum = twoSum(value, expansion_part[i]);
        value = sum.hi;
        if (sum.lo != 0.0lf) expansion_part[kept_parts++] = sum.lo;
    }
    if (value != 0.0lf) expansion_part[kept_parts++] = value;
    expansion_size = kept_parts;
}

/// The factors of the sum: products of a plane's slopes and the halves of a point's offset.
int depthDifferenceSign(DepthPlane p, DepthPlane q, dd dx, dd dy) {
    double slope[8] = double[8](p.dz_dx, -q.dz_dx, p.dz_dx, -q.dz_dx, p.dz_dy, -q.dz_dy, p.dz_dy, -q.dz_dy);
    double offset[8] = double[8](dx.lo, dx.lo, dx.hi, dx.hi, dy.lo, dy.lo, dy.hi, dy.hi);
    expansion_size = 0;
    for (int k = 0; k < 9; ++k) {
        dd product = dd(-q.z_anchor, p.z_anchor);
        if (k < 8) product = twoProd(slope[min(k, 7)], offset[min(k, 7)]);
        for (int half_of = 0; half_of < 2; ++half_of) expansionAdd((half_of == 0) == (k < 8) ? product.lo : product.hi);
    }
    if (expansion_size == 0) return 0;
    return expansion_part[expansion_size - 1] > 0.0lf ? 1 : -1;
}
