#include "pipeline/judge/plane.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace edgewise::judge {
namespace {

int radiusOf(const Taps& taps) {
    return static_cast<int>(taps.size() / 2);
}

void addScaled(double scale, const double* in, double* out, int count) {
    for (int x = 0; x < count; ++x) out[x] += scale * in[x];
}

Plane filteredDown(const Plane& plane, const Taps& taps) {
    Plane out(plane.width, plane.height);
    const int radius = radiusOf(taps);
    tbb::parallel_for(0, plane.height, [&](int y) {
        for (int i = -radius; i <= radius; ++i)
            addScaled(taps[static_cast<std::size_t>(i + radius)],
                      plane.row(std::clamp(y + i, 0, plane.height - 1)), out.row(y), plane.width);
    });
    return out;
}

Plane filteredAcross(const Plane& plane, const Taps& taps) {
    Plane out(plane.width, plane.height);
    const int radius = radiusOf(taps);
    tbb::parallel_for(0, plane.height, [&](int y) {
        const double* row = plane.row(y);
        std::vector<double> padded(static_cast<std::size_t>(radius), row[0]);
        padded.insert(padded.end(), row, row + plane.width);
        padded.insert(padded.end(), static_cast<std::size_t>(radius), row[plane.width - 1]);
        for (std::size_t i = 0; i < taps.size(); ++i)
            addScaled(taps[i], padded.data() + i, out.row(y), plane.width);
    });
    return out;
}

}  // namespace

Taps gaussianTaps(double sigma, int radius) {
    Taps taps;
    for (int i = -radius; i <= radius; ++i) taps.push_back(std::exp(-i * i / (2.0 * sigma * sigma)));
    return taps;
}

Taps normalized(Taps taps) {
    const double sum = std::accumulate(taps.begin(), taps.end(), 0.0);
    for (double& tap : taps) tap /= sum;
    return taps;
}

Plane filtered(const Plane& plane, const Taps& across, const Taps& down) {
    return filteredAcross(filteredDown(plane, down), across);
}

}  // namespace edgewise::judge
