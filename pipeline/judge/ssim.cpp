#include "pipeline/judge/ssim.h"

#include <algorithm>

#include "pipeline/judge/plane.h"
#include "pipeline/srgb.h"

namespace edgewise::judge {
namespace {

constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

Plane encodedChannel(const ImageBuffer& image, int channel) {
    Plane plane(image.box.width(), image.box.height());
    tbb::parallel_for(std::size_t{0}, plane.values.size(), [&](std::size_t i) {
        plane.values[i] = encodeSrgb(std::clamp(image.rgba[i][channel], 0.0, 1.0));
    });
    return plane;
}

Plane product(const Plane& a, const Plane& b) {
    Plane out(a.width, a.height);
    std::ranges::transform(a.values, b.values, out.values.begin(), std::multiplies<>());
    return out;
}

/// The window's mean at each pixel.
Plane windowMean(const Plane& plane) {
    static const Taps taps = normalized(gaussianTaps(kSsimSigma, kSsimRadius));
    return filtered(plane, taps, taps);
}

double ssimAt(double mx, double my, double mxx, double myy, double mxy) {
    const double var_x = mxx - mx * mx, var_y = myy - my * my, cov = mxy - mx * my;
    return (2.0 * mx * my + kC1) * (2.0 * cov + kC2) / ((mx * mx + my * my + kC1) * (var_x + var_y + kC2));
}

/// From the border to the first pixel whose window lies in a picture of this size, if there is one.
int margin(int size) {
    return size > 2 * kSsimRadius ? kSsimRadius : 0;
}

double meanSsim(const Plane& x, const Plane& y) {
    const Plane mx = windowMean(x), my = windowMean(y);
    const Plane mxx = windowMean(product(x, x)), myy = windowMean(product(y, y));
    const Plane mxy = windowMean(product(x, y));
    const int left = margin(x.width), top = margin(x.height);
    const int width = x.width - 2 * left, height = x.height - 2 * top;
    const double sum = sumRows(height, [&](int row) {
        double of_row = 0.0;
        const int v = row + top;
        for (int u = left; u < left + width; ++u)
            of_row += ssimAt(mx.row(v)[u], my.row(v)[u], mxx.row(v)[u], myy.row(v)[u], mxy.row(v)[u]);
        return of_row;
    });
    return sum / (static_cast<double>(width) * height);
}

}  // namespace

double ssim(const ImageBuffer& image, const ImageBuffer& reference) {
    double sum = 0.0;
    for (int channel = 0; channel < 3; ++channel)
        sum += meanSsim(encodedChannel(image, channel), encodedChannel(reference, channel));
    return sum / 3.0;
}

}  // namespace edgewise::judge
