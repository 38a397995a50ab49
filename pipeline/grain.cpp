#include "pipeline/grain.h"

#include <cmath>

#include "pipeline/sobol.h"

namespace edgewise {
namespace {

/// The sum of the squares of {1, 2, 1} x {1, 2, 1} / 16 taken from 1 in the middle.
constexpr double kBluePower = 9.0 / 16.0 + 4.0 / 64.0 + 4.0 / 256.0;

double whiteAt(int x, int y, std::uint64_t key) {
    const std::uint64_t pixel =
        (std::uint64_t(static_cast<std::uint32_t>(y)) << 32) | static_cast<std::uint32_t>(x);
    const double unit = static_cast<double>(mixed(key ^ mixed(pixel)) >> 11) * 0x1p-53;
    return std::sqrt(12.0) * (unit - 0.5);
}

double meanAround(int x, int y, std::uint64_t key) {
    double sum = 0.0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            sum += (dx == 0 ? 2.0 : 1.0) * (dy == 0 ? 2.0 : 1.0) / 16.0 * whiteAt(x + dx, y + dy, key);
    return sum;
}

}  // namespace

double grainAt(GrainSpectrum spectrum, int x, int y, std::uint64_t frame, std::uint64_t seed) {
    const std::uint64_t key = mixed(mixed(seed ^ 0x6772616979u) + frame);
    if (spectrum == GrainSpectrum::kWhite) return whiteAt(x, y, key);
    return (whiteAt(x, y, key) - meanAround(x, y, key)) / std::sqrt(kBluePower);
}

double grainDensity(GrainSpectrum spectrum, double u, double v) {
    if (spectrum == GrainSpectrum::kWhite) return 1.0;
    const double low = std::cos(M_PI * u) * std::cos(M_PI * v);
    return (1.0 - low * low) * (1.0 - low * low) / kBluePower;
}

}  // namespace edgewise
