// A rectangle of values read as a texture is: coordinates beyond the border read the border.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "pipeline/methods/stopwatch.h"
#include "pipeline/progress.h"

namespace edgewise {

/// Rows from the top; texel (x, y) has its centre at (x, y).
template <class T>
class Texels {
  public:
    Texels(int width, int height)
        : width_(width), height_(height), values_(static_cast<std::size_t>(width) * height) {}

    int width() const { return width_; }
    int height() const { return height_; }

    T& texel(int x, int y) { return values_[static_cast<std::size_t>(y) * width_ + x]; }

    /// The nearest texel of the rectangle.
    const T& at(int x, int y) const {
        const int row = std::clamp(y, 0, height_ - 1), column = std::clamp(x, 0, width_ - 1);
        return values_[static_cast<std::size_t>(row) * width_ + column];
    }

    /// Linear between the four nearest texels.
    T bilinear(float x, float y) const {
        const float left = std::floor(x), top = std::floor(y);
        const float u = x - left, v = y - top;
        const int i = static_cast<int>(left), j = static_cast<int>(top);
        const T upper = at(i, j) * (1.0f - u) + at(i + 1, j) * u;
        const T lower = at(i, j + 1) * (1.0f - u) + at(i + 1, j + 1) * u;
        return upper * (1.0f - v) + lower * v;
    }

  private:
    int width_, height_;
    std::vector<T> values_;
};

/// Calls `row(y)` for every row, in parallel, as a stage of the progress. Throws Interrupted when cancelled.
template <class Row>
void forRows(const char* stage, int height, Progress& progress, const Row& row) {
    progress.stage(stage, static_cast<std::size_t>(height));
    tbb::parallel_for(0, height, [&](int y) {
        checkCancelled(progress);
        row(y);
        progress.advance(1);
    });
}

}  // namespace edgewise
