// Whether the colours of samples differ by more than an edge does.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "pipeline/image_buffer.h"

namespace edgewise {

/// The extremes of colours, channel by channel.
struct ColorSpread {
    glm::dvec3 least{HUGE_VAL}, most{-HUGE_VAL};
    void add(const glm::dvec3& color) { least = glm::min(least, color), most = glm::max(most, color); }
    /// For ImageBuffer::edge.
    float edge() const {
        const glm::dvec3 d = most - least;
        return std::max({d.x, d.y, d.z}) > kEdgeContrast ? 1.0f : 0.0f;
    }
};

}  // namespace edgewise
