// sqrt(x^2 + y^2), rounded once but for what lies within 2^-50 ulp of a tie: the same bits with every libm.

/// The root of the sum to double-double accuracy: x^2 + y^2 within 2^-960 and 2^960.
EDGEWISE_FN real hypotenuse(real x, real y) {
    dd square = ddAdd(twoProd(x, x), twoProd(y, y));
    EDGEWISE_PRECISE real root = sqrt(square.hi);
    dd left = ddSub(square, twoProd(root, root));
    EDGEWISE_PRECISE real twice = root + root;
    EDGEWISE_PRECISE real correction = left.hi / (twice > EDGEWISE_REAL(0.0) ? twice : EDGEWISE_REAL(1.0));
    EDGEWISE_PRECISE real result = root + correction;
    return result;
}
