// The hit groups along a pixel's cone (Chubarau et al. 2023, section 3.3), and what each covers of it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "sdf/cone_settings.h"
#include "sdf/cone_step.h"
#include "sdf/sphere_trace.h"

namespace edgewise::sdf {

struct ConeGroup {
    double t = 0.0;      ///< where it is shaded
    double entry = 0.0;  ///< where the cone comes upon it: nothing of it lies before
    double least =
        1.0;  ///< the least distance met, in radii of the cone: the greatest occlusion is (1 - least) / 2
    bool hard = false;  ///< the ray itself meets the surface
};

struct ConeHits {
    /// More than these are not told apart: the last one takes their place.
    static constexpr int kMostGroups = 16;
    std::array<ConeGroup, kMostGroups> groups;
    int count = 0;
    std::uint32_t evaluations = 0;
    bool full = false;  ///< ended within the solid: no sky behind the last group
};

/// Ask the field at askedAt() and take() f / L times the ray's sign, as long as it asks.
class ConeTrace {
  public:
    ConeTrace(const FieldRay& ray, const TraceSettings& trace, const ConeSettings& settings);

    bool asks() const { return !cones::coneEnded(state_); }
    double askedAt() const { return cones::coneAt(state_); }
    void take(double value);
    const ConeHits& hits() const { return hits_; }

  private:
    void keepGroup();

    cones::ConeRules rules_{};
    cones::ConeState state_{};
    ConeHits hits_;
    std::uint32_t most_steps_;
};

/// The cone's rules for a ray: its radius is sqrt(2) times the pixel's (equation 3 as notes on it read it)
/// times the coverage.
cones::ConeRules coneRules(const FieldRay& ray, const TraceSettings& trace, const ConeSettings& settings);

/// Whether a group has all bits of the mask, whatever its normal: no point of the square around the base is
/// sqrt(2) away from its middle.
bool fillsMask(const ConeGroup& group, const ConeSettings& settings);

/// A group's bits: of a plane through its sample, `normal_world` unit, seen along a ray with these unit axes
/// across it, x to the right and y down.
std::uint32_t groupMask(const ConeGroup& group, const glm::dvec3& normal_world, const glm::dvec3& right_world,
                        const glm::dvec3& down_world, const ConeSettings& settings);

/// What samples of groups add up to, front to back.
class ConeBlend {
  public:
    explicit ConeBlend(const ConeSettings& settings) : settings_(settings) {}

    /// The part of the group's bits that nothing before it covers.
    std::uint32_t uncovered(std::uint32_t bits) const { return bits & ~covered_; }
    /// Whether more groups could be seen.
    bool open() const;
    void add(std::uint32_t uncovered_bits, const glm::dvec4& color);
    /// Whether what lies behind all groups has a part.
    bool skyShows() const;
    /// With what lies behind all groups.
    glm::dvec4 over(const glm::dvec4& sky) const;

  private:
    /// The sums are divided by the weights.
    bool normalized() const;

    ConeSettings settings_;
    std::uint32_t covered_ = 0;
    glm::dvec4 sum_{0.0};
    double weight_ = 0.0;
};

}  // namespace edgewise::sdf
