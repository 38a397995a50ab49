// A field that is asked at many points at once: what a device runs.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace edgewise::sdf {

class PointField {
  public:
    virtual ~PointField() = default;
    /// By point; inside is below 0.
    virtual std::vector<double> values(std::span<const glm::dvec3> points_world) const = 0;
    /// Linear colours of the surface by point and unit normal; empty: the field has none of its own.
    virtual std::vector<glm::dvec3> colors(std::span<const glm::dvec3> /*points_world*/,
                                           std::span<const glm::dvec3> /*normals_world*/) const {
        return {};
    }
    /// Values are said to change no faster.
    virtual double lipschitz() const = 0;
    /// Of its numbers, relative: 2^-24 for float.
    virtual double rounding() const = 0;
};

}  // namespace edgewise::sdf
