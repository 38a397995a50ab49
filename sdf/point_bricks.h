// The bricks of a lattice that a field's surface passes, where the field is asked at many points at once.
#pragma once

#include <functional>

#include "sdf/brick_source.h"
#include "sdf/point_field.h"

namespace edgewise::sdf {

/// Bricks, by their place among Lattice::bricks(), that the surface may pass: by an octree, a level at a
/// time, whose nodes go where the bound says so. All of them, with `bound_holds` false, where values are seen
/// to change faster.
struct NearBricks {
    std::vector<glm::ivec3> bricks;
    std::uint64_t nodes = 0, pruned = 0;
    bool open = false;  ///< a node that was left out is inside and reaches the lattice's end
    bool bound_holds = true;
};
/// Throws SceneError for more of them than can be looked at so.
NearBricks bricksNear(const PointField& field, const Lattice& lattice);

/// Values at all corners of bricks whose signs differ, and crossings of their edges.
class PointBricks : public BrickSource {
  public:
    /// `between` is called after every batch of points, and may throw.
    PointBricks(const PointField& field, const Lattice& lattice, std::function<void()> between = {});

    const BrickList& list() const { return list_; }
    bool boundHolds() const { return bound_holds_; }
    const std::vector<Crossing>& crossings() const { return crossings_; }
    /// Of the edge along the axis from a corner on, in cells of the lattice; kNoBrick: nothing is crossed.
    std::uint32_t crossingAt(const glm::ivec3& corner, int axis) const;

    void readValues(std::size_t brick, BrickCrossings& into) const override;
    void read(std::size_t brick, BrickCrossings& into) const override;

  private:
    static constexpr std::size_t kOwned = 3 * kBrickCells * kBrickCells * kBrickCells;

    void keepCrossed(const std::vector<glm::ivec3>& bricks);
    void keep(const glm::ivec3& brick, std::span<const double> values);
    void checkSteps(std::span<const double> values);
    bool isWhole() const;
    void findCrossings();
    std::size_t indexOf(const glm::ivec3& brick) const;
    std::uint32_t brickAt(const glm::ivec3& brick) const;
    glm::ivec3 placeOf(std::size_t brick) const { return list_.bricks[brick].first / (kBrickCells * kUnits); }
    void pause() const {
        if (between_) between_();
    }

    const PointField& field_;
    const Lattice& lattice_;
    const std::function<void()> between_;
    BrickList list_;
    bool bound_holds_ = true;
    std::vector<double> values_;             ///< by brick, then BrickCrossings::indexOf()
    std::vector<std::uint32_t> crossed_at_;  ///< by brick, corner and axis: of `crossings_`
    std::vector<Crossing> crossings_;
};

}  // namespace edgewise::sdf
