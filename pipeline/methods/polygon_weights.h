// What a convex polygon weighs in the prefilter of the samples around it: NSAA's closed form for one owner.
#pragma once

#include <span>
#include <vector>

#include "analytic/pixel_weights.h"

namespace edgewise {

/// Pixel (x, y) of the film and the integral of its filter over the polygon.
struct PixelShare {
    int x, y;
    double weight;
};

class PolygonWeights {
  public:
    explicit PolygonWeights(const Prefilter& filter) : radius_(filter.radius), weights_(filter) {}

    /// Of all pixels whose support meets the polygon, row by row; adds to `out`. Corners are rounded to the
    /// grid of 2^-32 px; errors as edgeTerms() states them.
    void add(std::span<const glm::dvec2> polygon_px, std::vector<PixelShare>& out);

  private:
    void addRow(std::span<const glm::dvec2> corners, int y, int x0, int x1, std::vector<PixelShare>& out);

    double radius_;
    PixelWeights weights_;
    std::vector<EdgeInput> edges_;
    std::vector<char> inner_is_left_;
};

}  // namespace edgewise
