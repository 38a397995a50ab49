// The sum of a pixel: weights times colours in the owners' order. `bits64` is a signed 64-bit integer.

/// A weight in units of 2^-60, as the nearest double.
EDGEWISE_EXACT_FN double realWeight(bits64 weight) { return double(weight) * EDGEWISE_REAL(8.673617379884035e-19); }

struct PixelSum {
    dvec3 color;
    bits64 covered;       // weights of what is wholly there
    double half_covered;  // weights times alpha of the rest
    dvec3 low;            // range of the colours
    dvec3 high;
};

EDGEWISE_EXACT_FN PixelSum withOwner(PixelSum sum, bits64 weight, dvec3 color, double alpha) {
    double w = realWeight(weight);
    sum.color += w * color;
    if (alpha == 1.0)
        sum.covered += weight;
    else
        sum.half_covered += w * alpha;
    sum.low = dvec3(smaller(sum.low.x, color.x), smaller(sum.low.y, color.y), smaller(sum.low.z, color.z));
    sum.high = dvec3(larger(sum.high.x, color.x), larger(sum.high.y, color.y), larger(sum.high.z, color.z));
    return sum;
}

EDGEWISE_EXACT_FN double alphaOf(PixelSum sum) { return realWeight(sum.covered) + sum.half_covered; }

/// The widest range of a channel.
EDGEWISE_EXACT_FN double contrastOf(PixelSum sum) {
    dvec3 span = sum.high - sum.low;
    return larger(larger(span.x, span.y), span.z);
}
