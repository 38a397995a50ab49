#include "data/generate/portable_math.h"

namespace edgewise::scenes {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;

/// Taylor polynomials for |x| <= pi/4, innermost term first.
double sinSeries(double x) {
    double sum = 1.0;
    for (int k = 18; k >= 2; k -= 2) sum = 1.0 - x * x / (k * (k + 1)) * sum;
    return x * sum;
}

double cosSeries(double x) {
    double sum = 1.0;
    for (int k = 19; k >= 1; k -= 2) sum = 1.0 - x * x / (k * (k + 1)) * sum;
    return sum;
}

/// A point uniform in the unit disk without its centre, and its squared distance to it.
struct DiskPoint {
    Vec2 p;
    double r2;
};

DiskPoint randomInDisk(SplitMix64& random) {
    for (;;) {
        const double x = random.between(-1.0, 1.0);
        const double y = random.between(-1.0, 1.0);
        const double r2 = x * x + y * y;
        if (r2 > 1e-6 && r2 < 1.0) return {{x, y}, r2};
    }
}

}  // namespace

Vec2 onCircle(double turns) {
    const double quarter = std::floor(4.0 * turns + 0.5);
    const double x = kTwoPi * (turns - 0.25 * quarter);
    const double c = cosSeries(x), s = sinSeries(x);
    switch (static_cast<long long>(quarter) & 3) {
        case 0:
            return {c, s};
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        default:
            return {s, -c};
    }
}

double binaryLog(double x) {
    double log = 0.0;
    for (; x >= 2.0; x *= 0.5) log += 1.0;
    for (double digit = 0.5; digit >= 0x1p-48; digit *= 0.5) {
        x *= x;
        if (x < 2.0) continue;
        x *= 0.5;
        log += digit;
    }
    return log;
}

std::uint64_t SplitMix64::next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

Vec2 randomOnCircle(SplitMix64& random) {
    const DiskPoint d = randomInDisk(random);
    const double scale = 1.0 / std::sqrt(d.r2);
    return {scale * d.p.x, scale * d.p.y};
}

Axes randomAxes(SplitMix64& random) {
    const DiskPoint a = randomInDisk(random);
    const DiskPoint b = randomInDisk(random);
    const double scale = std::sqrt((1.0 - a.r2) / b.r2);
    const double x = a.p.x, y = a.p.y, z = scale * b.p.x, w = scale * b.p.y;
    return {{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)},
            {2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)}};
}

}  // namespace edgewise::scenes
