// One number a pixel, and what the metrics do with it: filter, and add up in an order that threads cannot
// change.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>
#include <vector>

namespace edgewise::judge {

/// Rows from the top.
struct Plane {
    int width = 0, height = 0;
    std::vector<double> values;

    Plane(int w, int h)
        : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    double* row(int y) { return values.data() + static_cast<std::size_t>(y) * width; }
    const double* row(int y) const { return values.data() + static_cast<std::size_t>(y) * width; }
};

/// Weights at the offsets -radius .. radius: an odd number of them.
using Taps = std::vector<double>;

/// exp(-i^2 / (2 sigma^2)) for |i| <= radius; sigma in pixels. Not normalised.
Taps gaussianTaps(double sigma, int radius);

/// Divided by their sum.
Taps normalized(Taps taps);

/// out(x, y) = sum over i, j of across[i] down[j] in(x + i - radius, y + j - radius); beyond its border a
/// plane goes on with the border's value.
Plane filtered(const Plane& plane, const Taps& across, const Taps& down);

/// row_sum(0) + row_sum(1) + ...: computed in parallel, added from the top.
template <class RowSum>
auto sumRows(int height, const RowSum& row_sum) {
    std::vector<decltype(row_sum(0))> rows(static_cast<std::size_t>(height));
    tbb::parallel_for(0, height, [&](int y) { rows[static_cast<std::size_t>(y)] = row_sum(y); });
    decltype(row_sum(0)) sum{};
    for (const auto& row : rows) sum += row;
    return sum;
}

}  // namespace edgewise::judge
