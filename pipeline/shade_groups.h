// Many samples shaded at once, owner by owner: what an owner's samples share is made once, and several of
// them are computed a step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/shade.h"

namespace edgewise {

/// begin(), add() any number of (owner, sample), finish(). One thread's.
class Shading::Groups {
  public:
    Groups() : functions_(chooseSurfaceFunctions()) {}

    /// `most` bounds the calls of add().
    void begin(std::size_t most);

    /// The colour of out[entry] becomes that of closest(owner, sample_px); alpha stays. The owner has pieces.
    void add(Owner owner, glm::dvec2 sample_px, std::uint32_t entry);

    /// The bits of Shading::closest(), whatever the order of add() and the instruction set.
    void finish(const Shading& shading, std::span<Shade> out);

  private:
    static constexpr std::uint32_t kEnd = ~0u;
    struct Item {
        glm::dvec2 sample_px;
        std::uint32_t entry, next;
    };
    struct Group {
        Owner owner;
        std::uint32_t first;
    };
    /// Calls visit(items, count) for up to kSurfaceLanes items of a group at a time.
    template <class Visit>
    void forEachBatch(std::uint32_t first, const Visit& visit);
    void fill(std::uint32_t first, const glm::dvec3& color, std::span<Shade> out) const;
    void finishPlain(const Shading& shading, const Surface& surface, const LaneMaterial& look, Group group,
                     std::span<Shade> out);
    void finishAny(const Shading& shading, Surface& surface, Group group, std::span<Shade> out);

    SurfaceFunctions functions_;
    LaneFrame frame_;
    std::vector<LaneLight> lights_;
    std::vector<std::uint32_t> slots_;  ///< a hash table of owners: 1 + the group, or 0
    std::vector<Group> groups_;
    std::vector<Item> items_;
    LaneSamples samples_{};
};

}  // namespace edgewise
