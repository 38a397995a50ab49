// The finished picture: linear Rec.709, double precision, one window of the film.
#pragma once

#include <cstddef>
#include <glm/vec4.hpp>

#include "pipeline/aov_image.h"
#include "pipeline/film.h"
#include "pipeline/huge_pages.h"

namespace edgewise {

/// Pixels in rows from the top. The colour holds the background already; alpha is the sum of the other
/// owners' weights, which may be negative with negative lobes.
struct ImageBuffer {
    PixelBox box;
    ZeroedVector<glm::dvec4> rgba;
    ZeroedVector<float>
        edge;      ///< 1 where the filter's support holds visible owners that differ by more than 1/255
    AovImage aov;  ///< empty but for --aov

    ImageBuffer() = default;
    explicit ImageBuffer(const PixelBox& pixels)
        : box(pixels), rgba(static_cast<std::size_t>(box.width()) * box.height()), edge(rgba.size()) {}

    std::size_t bytes() const {
        return rgba.size() * sizeof(glm::dvec4) + edge.size() * sizeof(float) + aov.bytes();
    }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - box.y0) * box.width() + (x - box.x0);
    }
};

/// Colours further apart than this in some channel make an edge.
inline constexpr double kEdgeContrast = 1.0 / 255.0;

}  // namespace edgewise
