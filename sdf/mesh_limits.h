// How far a mesh may be off its surface.
#pragma once

#include <vector>

#include "sdf/mesh_lattice.h"

namespace edgewise::sdf {

/// Lengths in the world.
struct MeshLimits {
    double sharp;   ///< by sharp edges
    double smooth;  ///< elsewhere
};

/// Where sharp edges are.
class SharpBricks {
  public:
    SharpBricks(const Lattice& lattice, const BrickList& bricks, std::vector<bool> sharp)
        : lattice_(lattice), bricks_(bricks), sharp_(std::move(sharp)) {}
    bool at(const glm::dvec3& p_world) const {
        const std::uint32_t brick = bricks_.leafAt(lattice_, lattice_.unitAt(p_world)).brick;
        return brick == kNoBrick || sharp_[brick];
    }
    bool operator[](std::uint32_t brick) const { return sharp_[brick]; }

  private:
    const Lattice& lattice_;
    const BrickList& bricks_;
    std::vector<bool> sharp_;
};

}  // namespace edgewise::sdf
