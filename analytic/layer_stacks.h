// Owners that are seen through each other: a stack of layers is one owner of the visible map.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <unordered_map>
#include <vector>

#include "analytic/screen_triangle.h"

namespace edgewise {

/// Owners from here to below kBackground name stacks; triangles lie below.
inline constexpr Owner kFirstStack = 0x80000000u;
inline bool isStack(Owner owner) {
    return owner >= kFirstStack && owner != kBackground;
}

/// Nothing is shaded through more see-through layers than this.
inline constexpr std::size_t kMaxLayers = 255;

/// Where nothing is shaded, beside a picture, stacks may be deeper, up to this.
inline constexpr std::size_t kMostLayers = 4096;

/// Thrown where a stack would have more.
struct LayerLimit {
    glm::dvec2 at_px;
};

/// Sequences of triangles from front to back, all but the last see-through; the last is what ends the view:
/// an opaque triangle or the background. Each sequence is held once and named by an Owner.
class LayerStacks {
  public:
    /// The owner that these layers are: a single layer is its own.
    Owner owner(std::span<const Owner> layers);

    /// The layers of an owner that is a stack of this table.
    std::span<const Owner> layers(Owner stack) const {
        const std::size_t i = stack - kFirstStack;
        return std::span(layers_).subspan(first_[i], first_[i + 1] - first_[i]);
    }

    /// The layers of any owner; a single one is its own.
    std::span<const Owner> layersOf(const Owner& owner) const {
        return isStack(owner) ? layers(owner) : std::span(&owner, 1);
    }

    std::size_t size() const { return first_.size() - 1; }
    bool empty() const { return size() == 0; }

    /// One table of all the stacks of several, sorted by their layers, whatever the parts and their order.
    /// names[p][i] becomes the owner that stack i of part p is in it.
    static LayerStacks joined(std::span<const LayerStacks* const> parts,
                              std::vector<std::vector<Owner>>& names);

  private:
    std::vector<Owner> layers_;
    std::vector<std::uint32_t> first_ = {0};
    std::unordered_multimap<std::uint64_t, Owner> by_hash_;
};

}  // namespace edgewise
