// The lines of a leaf: edges and lines of equal depth, clipped to the cell, with the events where they meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analytic/cell_clip.h"
#include "analytic/local_plane.h"

namespace edgewise {

/// Two lines meet.
struct LeafEvent {
    OrderKey key;
    std::uint32_t p, q;
    FinePoint point;
};

/// Collects the lines of one leaf. A row of `words` 64-bit words a line says which triangles it bounds.
class LeafLines {
  public:
    void collect(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                 std::span<const std::uint32_t> triangles, const VisibilityOptions& options,
                 VisibilityCounts& counts);

    /// Fills keys and ordinates, and sorts what happens by them: for what sweeps slab by slab.
    void sortKeys();

    std::vector<LocalPlane> planes;  ///< one a triangle
    std::vector<LeafLine> lines;
    std::vector<LeafHorizontal> horizontals;
    std::vector<LeafEvent> events;
    std::vector<OrderKey> keys;             ///< of all events, ends and borders, ascending, distinct
    std::vector<FineCoordinate> ordinates;  ///< one a key
    std::vector<std::uint64_t> masks;
    std::vector<std::uint64_t> see_through;  ///< one row: the triangles that are
    bool any_see_through = false;
    std::size_t words = 1;
    CellFrame frame;

  private:
    void addEdge(const ScreenScene& scene, std::uint32_t triangle, std::uint32_t edge, std::size_t bit);
    void addDepthLines(const ScreenScene& scene, std::span<const std::uint32_t> triangles, bool every,
                       VisibilityCounts& counts);
    void addDepthLine(const ScreenScene& scene, LineRef ref);
    void addCrossings();
    void addKey(OrderKey key, FineCoordinate y);

    std::vector<std::pair<OrderKey, FineCoordinate>> key_scratch_;
};

}  // namespace edgewise
