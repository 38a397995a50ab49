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
    /// What shares a step: up to kSurfaceLanes samples of surfaces that are shaded alike.
    struct Batch {
        const LaneMaterial* look = nullptr;  ///< none: each by itself, at its place
        bool smooth = false;
        int count = 0, surface_count = 0;
        SurfaceLanes lanes{};
        std::uint32_t item[kSurfaceLanes] = {};
        Owner owner[kSurfaceLanes] = {};
        int surface_of[kSurfaceLanes] = {};
        Surface surface[kSurfaceLanes];
    };
    void finish(const Shading& shading, Group group, std::span<Shade> out);
    void finishSingly(const Shading& shading, Group group, std::span<Shade> out) const;
    void fill(std::uint32_t first, const glm::dvec3& color, std::span<Shade> out) const;
    void enqueue(const Shading& shading, Group group, const Surface& surface, const LaneMaterial* look,
                 std::span<Shade> out);
    void flush(const Shading& shading, std::span<Shade> out);
    void flushAlike(const Shading& shading, std::span<Shade> out);
    void flushApart(const Shading& shading, std::span<Shade> out);

    SurfaceFunctions functions_;
    LaneFrame frame_;
    std::vector<LaneLight> lights_;
    std::size_t most_ = 0;
    std::vector<std::uint32_t> slots_;  ///< a hash table of owners: 1 + the group, or 0
    std::vector<Group> groups_;
    std::vector<Item> items_;
    Batch batch_;
};

}  // namespace edgewise
