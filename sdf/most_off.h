// How far a mesh and the surface that it stands for may be apart.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <utility>

namespace edgewise::sdf {

/// By place, lengths in the world above 0.
class MostOff {
  public:
    /// The least that holds anywhere within a ball.
    using LeastWithin = std::function<double(const glm::dvec3& centre_world, double radius)>;

    MostOff(double everywhere) : everywhere_(everywhere) {}
    explicit MostOff(LeastWithin least_within) : least_within_(std::move(least_within)) {}

    double leastWithin(const glm::dvec3& centre_world, double radius) const {
        return part_ * (least_within_ ? least_within_(centre_world, radius) : everywhere_);
    }
    double at(const glm::dvec3& p_world) const { return leastWithin(p_world, 0.0); }
    MostOff times(double part) const {
        MostOff less = *this;
        less.part_ *= part;
        return less;
    }

  private:
    double everywhere_ = 0.0, part_ = 1.0;
    LeastWithin least_within_;
};

}  // namespace edgewise::sdf
