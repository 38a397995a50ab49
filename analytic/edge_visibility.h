// Visibility of a leaf edge by edge, after Auzinger, Wimmer and Jeschke, Analytic Visibility on the GPU
// (2013): every edge is cut where it meets other triangles' edges, the cuts are sorted along it, and running
// sums of entries and exits say what covers either side of each part; a part is visible where its sides see
// different owners.
//
// Within that paper's limits this gives SlabSweep's segments. Triangles that pierce each other are beyond
// them: no edge runs where they change order, and their owners' boundaries are left open. So are see-through
// ones.
#pragma once

#include <span>
#include <vector>

#include "analytic/local_plane.h"
#include "analytic/row_crossings.h"

namespace edgewise {

/// Holds the scratch memory of one thread.
class EdgeVisibility {
  public:
    /// The owners of `cell` among `triangles` (indices into scene.triangles, all opaque), appended to `out`.
    /// `origin`: a grid point near the cell, the frame of its arithmetic. O(triangles^3), of the few in a
    /// leaf.
    void run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
             std::span<const std::uint32_t> triangles, CellOutput& out);

  private:
    /// The sides of an edge that is moved by less than anything, and what lies on it: edges of the same line.
    enum Side { kLeft, kRight, kOn };
    /// An edge of one triangle or more, clipped to the cell.
    struct Edge {
        LeafLine line;  ///< of a horizontal one the carrier and the ends alone
        OrderKey from, to;
        bool horizontal = false;
    };
    /// Along an edge, on one side of it, a triangle begins (+1) or ends (-1) to cover.
    struct Event {
        OrderKey key;
        FinePoint at;
        Side side;
        std::uint32_t cover;  ///< the triangle's place; on the edge: the other edge's
        int by;
    };
    struct Cover {
        OrderKey from, to;
        FinePoint begin, end;
    };
    /// Where a triangle begins or ends to cover one side of an edge.
    struct Cut {
        bool found = false;
        bool beyond = false;  ///< the edge's own end comes first
        FinePoint at;
    };

    void addEdge(std::uint32_t triangle, std::uint32_t k);
    void cut(const Edge& edge);
    void coverBy(const Edge& edge, std::uint32_t triangle, Side side);
    void coverByEdge(const Edge& edge, std::uint32_t other);
    void addCover(const Edge& edge, Side side, std::uint32_t cover, const Cover& part);
    Cut cutBy(const Carrier& edge, std::uint32_t triangle, std::uint32_t k, Side side, bool enters) const;
    OrderKey keyAlong(const Edge& edge, const FinePoint& p) const;
    void walk(const Edge& edge);
    Owner nearest(const Edge& edge, Side side, const FinePoint& a, const FinePoint& b) const;
    bool inFront(const Edge& edge, Side side, std::uint32_t p, std::uint32_t q, const FinePoint& a,
                 const FinePoint& b) const;
    bool inFrontBetween(std::uint32_t p, std::uint32_t q, const FinePoint& a, const FinePoint& b) const;
    bool endsIn(const Edge& edge, std::uint32_t triangle) const;
    void emit(const Edge& edge, Owner left, Owner right, const FinePoint& a, const FinePoint& b);
    Owner ownerAt(glm::dvec2 p) const;
    const ScreenTriangle& triangle(std::uint32_t place) const { return scene_->triangles[triangles_[place]]; }

    const ScreenScene* scene_ = nullptr;
    std::span<const std::uint32_t> triangles_;
    CellOutput* out_ = nullptr;
    CellFrame frame_;
    std::vector<LocalPlane> planes_;  ///< one a triangle
    std::vector<Edge> edges_;
    std::vector<Event> events_;
    std::vector<std::uint32_t> covers_[3];  ///< by side: what covers it here
    RowCrossings crossings_;
};

}  // namespace edgewise
