#include "analytic/quad_real.h"

#include <cmath>

namespace edgewise {

QuadReal quadSqrt(QuadReal x) {
    if (x <= 0) return 0;
    QuadReal root = std::sqrt(static_cast<double>(x));
    for (int i = 0; i < 4; ++i) root = (root + x / root) / 2;
    return root;
}

// Machin: pi = 16 atan(1/5) - 4 atan(1/239).
QuadReal quadPi() {
    auto inverseAtan = [](int n) {
        QuadReal power = QuadReal(1) / n, sum = 0;
        for (int k = 0; k < 60; ++k, power /= QuadReal(n) * n) sum += (k % 2 ? -power : power) / (2 * k + 1);
        return sum;
    };
    static const QuadReal pi = 16 * inverseAtan(5) - 4 * inverseAtan(239);
    return pi;
}

QuadReal quadSinPi(QuadReal x) {
    const QuadReal turns = x / 2;
    long whole = static_cast<long>(turns);
    QuadReal r = (turns - whole) * 2;  // in (-2, 2)
    if (r > 1) r -= 2;
    if (r < -1) r += 2;
    if (r > QuadReal(1) / 2) r = 1 - r;
    if (r < -QuadReal(1) / 2) r = -1 - r;
    const QuadReal z = r * quadPi();
    QuadReal term = z, sum = z;
    for (int k = 1; k < 20; ++k) sum += term *= -z * z / ((2 * k) * (2 * k + 1));
    return sum;
}

QuadReal quadExp(QuadReal x) {
    QuadReal r = x / 16384, term = 1, sum = 0;  // e^r - 1, doubled in the form that keeps its digits
    for (int k = 1; k < 24; ++k) sum += term *= r / k;
    for (int i = 0; i < 14; ++i) sum = sum * (2 + sum);
    return 1 + sum;
}

}  // namespace edgewise
