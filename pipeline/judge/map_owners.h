// What a visible map says: the owner at a point and the owners' areas, from its segments.
#pragma once

#include <map>
#include <optional>

#include "pipeline/judge/walls.h"

namespace edgewise::judge {

/// The map's segments as straight walls between their ends.
std::vector<Wall> wallsOf(const VisibleMap& map);

class MapOwners {
  public:
    explicit MapOwners(const VisibleMap& map);

    const std::vector<Wall>& walls() const { return walls_; }

    /// By the nearest wall to the right, else to the left, below or above, else by a sample row; nothing
    /// where that is within the rounding of 113 bits of being a wall's other side.
    std::optional<Owner> at(const FinePoint& p) const;

    /// Whether the nearest walls at the left and at the right, `turned` above and below, have this owner at
    /// the point's side. Those within `reach_px` of the nearest count together: rounding may exchange them.
    /// Where there is none, or behind them the same owner again, nothing contradicts.
    bool confirmed(const FinePoint& p, Owner owner, bool turned, double reach_px) const;

    /// Each owner's area in the box, which lies in the map's window: px^2, exact for the segments.
    std::map<Owner, exact::Rational> areas(const exact::Region& box) const;

  private:
    std::optional<Owner> ownerRightOf(const exact::Region& box) const;

    const VisibleMap& map_;
    std::vector<Wall> walls_, exchanged_;
    std::vector<exact::Point> a_, b_;  ///< of each wall
};

}  // namespace edgewise::judge
