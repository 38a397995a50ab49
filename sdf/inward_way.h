// A way from a place in a solid (or outside it) to where it is thicker.
#pragma once

#include <glm/geometric.hpp>

#include "sdf/evaluate.h"
#include "sdf/tape_at.h"

namespace edgewise::sdf {

/// Along which a tape's value goes ever further from 0, by steps of what the Lipschitz bound allows: it stays
/// on its side of the surface. Between the two sides of a wedge it follows their middle.
class InwardWay {
  public:
    InwardWay(const TapeAt& tape, double lipschitz, const glm::dvec3& from_world, bool solid)
        : tape_(tape), lipschitz_(lipschitz), sign_(solid ? -1.0 : 1.0), place_(from_world) {}

    /// False: it goes no further.
    bool isOn() {
        const ValueAndGradient at = gradientAt(tape_(place_), place_);
        const double before = depth_, slope = glm::length(at.gradient);
        depth_ = sign_ * at.value;
        normal_ = sign_ / slope * at.gradient;
        return depth_ > before && slope > 0.0;
    }
    const glm::dvec3& place() const { return place_; }
    /// No part of the surface is nearer.
    double reach() const { return depth_ / lipschitz_; }
    double length() const { return length_; }

    void step() {
        const double step = kPart * reach();
        place_ += step * direction(step), length_ += step;
    }

  private:
    static constexpr double kPart = 0.5, kOpposite = 1e-3;

    glm::dvec3 direction(double step) const {
        const glm::dvec3 ahead = place_ + step * normal_,
                         beyond = sign_ * gradientAt(tape_(ahead), ahead).gradient;
        const double slope = glm::length(beyond);
        if (!(slope > 0.0)) return normal_;
        const glm::dvec3 both = normal_ + beyond / slope;
        const double length = glm::length(both);
        return length > kOpposite ? both / length : normal_;
    }

    const TapeAt& tape_;
    const double lipschitz_, sign_;
    glm::dvec3 place_, normal_{0.0};
    double depth_ = 0.0, length_ = 0.0;
};

}  // namespace edgewise::sdf
