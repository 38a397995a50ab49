#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "sdf/brick_source.h"
#include "sdf/mesh_attributes.h"
#include "sdf/polygonize.h"
#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

using Loop = std::vector<int>;  ///< a cell's edges in order

Loop edgesOf(const CellLoops& loops, int loop) {
    Loop edges;
    int edge = loops.first[loop];
    do edges.push_back(edge), edge = loops.next[edge];
    while (edge != loops.first[loop]);
    return edges;
}

bool shareFace(int a, int b) {
    const EdgeEnds p = edgeEnds(a), q = edgeEnds(b);
    return (p.low & p.high & q.low & q.high) != 0 || (p.low | p.high | q.low | q.high) != kCellCorners - 1;
}

/// The triangulation of a loop with the least area (Klincsek 1980), without diagonals in a face of the cell:
/// the neighbour might have the same one there.
class LeastArea {
  public:
    LeastArea(const Loop& edges, const std::array<glm::dvec3, kCellEdges>& places)
        : edges_(edges), places_(places), count_(static_cast<int>(edges.size())) {}

    /// In indices into the loop; empty: there is none.
    std::vector<Triangle> run() {
        for (int width = 2; width < count_; ++width)
            for (int i = 0; i + width < count_; ++i) choose(i, i + width);
        if (!std::isfinite(area_[0][count_ - 1])) return {};
        collect(0, count_ - 1);
        return triangles_;
    }

  private:
    bool allowed(int i, int j) const {
        const bool side = j == i + 1 || (i == 0 && j == count_ - 1);
        return side || !shareFace(edges_[i], edges_[j]);
    }
    void choose(int i, int j) {
        double best = std::numeric_limits<double>::infinity();
        if (allowed(i, j))
            for (int k = i + 1; k < j; ++k) {
                const glm::dvec3 &a = places_[edges_[i]], &b = places_[edges_[k]], &c = places_[edges_[j]];
                const double area = area_[i][k] + area_[k][j] + glm::length(glm::cross(b - a, c - a));
                if (area < best) best = area, middle_[i][j] = k;
            }
        area_[i][j] = best;
    }
    void collect(int i, int j) {
        if (j < i + 2) return;
        const int k = middle_[i][j];
        triangles_.push_back({std::uint32_t(i), std::uint32_t(k), std::uint32_t(j)});
        collect(i, k), collect(k, j);
    }

    const Loop& edges_;
    const std::array<glm::dvec3, kCellEdges>& places_;
    const int count_;
    double area_[kCellEdges][kCellEdges] = {};
    int middle_[kCellEdges][kCellEdges] = {};
    std::vector<Triangle> triangles_;
};

class MarchingCubes {
  public:
    MarchingCubes(const Lattice& lattice, const BrickList& bricks, const BrickSource& source,
                  MeshCounts& counts)
        : lattice_(lattice), bricks_(bricks), source_(source), counts_(counts) {}

    SurfaceMesh run() {
        counts_.nodes = bricks_.nodes, counts_.pruned = bricks_.pruned;
        counts_.bricks = bricks_.bricks.size();
        requireClosed(bricks_.open);
        vertex_.assign(bricks_.bricks.size() * kOwned, kNoBrick);
        for (std::size_t b = 0; b < bricks_.bricks.size(); ++b) takeCrossings(b);
        for (std::size_t b = 0; b < bricks_.bricks.size(); ++b) takeCells(b);
        return std::move(mesh_);
    }

  private:
    static constexpr std::size_t kOwned = 3 * kBrickCells * kBrickCells * kBrickCells;

    void requireClosed(bool open) const {
        if (open) throw SceneError("surface", "it reaches the end of the box: the mesh would be open");
    }

    std::uint32_t& vertexAt(const glm::ivec3& corner, int axis) {
        const glm::ivec3 count = lattice_.bricks(), brick = corner / kBrickCells, in = corner % kBrickCells;
        const std::size_t at = brick.x + std::size_t(count.x) * (brick.y + std::size_t(count.y) * brick.z);
        const std::size_t edge = axis + 3 * (in.x + kBrickCells * (in.y + kBrickCells * in.z));
        return vertex_[bricks_.at[at] * kOwned + edge];
    }

    void takeCrossings(std::size_t b) {
        const Brick& brick = bricks_.bricks[b];
        source_.read(b, crossings_);
        requireClosed(crossings_.open(lattice_, brick));
        for (int n = 0; n < kBrickCells * kBrickCells * kBrickCells; ++n) {
            const glm::ivec3 corner(n % kBrickCells, n / kBrickCells % kBrickCells,
                                    n / (kBrickCells * kBrickCells));
            for (int axis = 0; axis < 3; ++axis)
                if (const Crossing* c = crossings_.crossing(corner, axis)) {
                    vertexAt(brick.first / kUnits + corner, axis) =
                        static_cast<std::uint32_t>(mesh_.position_world.size());
                    mesh_.position_world.push_back(c->place_world);
                }
        }
    }

    void takeCells(std::size_t b) {
        const Brick& brick = bricks_.bricks[b];
        source_.readValues(b, values_);
        for (int n = 0; n < kBrickCells * kBrickCells * kBrickCells; ++n) {
            const glm::ivec3 cell(n % kBrickCells, n / kBrickCells % kBrickCells,
                                  n / (kBrickCells * kBrickCells));
            if (values_.crosses(cell)) takeCell(brick.first / kUnits + cell, cell);
        }
    }

    void takeCell(const glm::ivec3& at, const glm::ivec3& cell) {
        ++counts_.cells;
        double values[kCellCorners];
        values_.cellValues(cell, values);
        const CellLoops loops = loopsOf(values);
        std::array<std::uint32_t, kCellEdges> vertex{};
        std::array<glm::dvec3, kCellEdges> place;
        for (int e = 0; e < kCellEdges; ++e) {
            if (loops.loop[e] < 0) continue;
            const EdgeEnds ends = edgeEnds(e);
            const glm::ivec3 corner = at + BrickCrossings::cornerOffset(ends.low);
            vertex[e] = vertexAt(corner, ends.axis);
            place[e] = mesh_.position_world[vertex[e]];
        }
        for (int loop = 0; loop < loops.count; ++loop) addLoop(edgesOf(loops, loop), vertex, place);
    }

    void addLoop(const Loop& edges, const std::array<std::uint32_t, kCellEdges>& vertex,
                 const std::array<glm::dvec3, kCellEdges>& place) {
        const std::vector<Triangle> triangles = LeastArea(edges, place).run();
        for (const Triangle& t : triangles)
            mesh_.triangles.push_back({vertex[edges[t[0]]], vertex[edges[t[2]]], vertex[edges[t[1]]]});
        if (!triangles.empty()) return;
        glm::dvec3 centre(0.0);
        for (const int e : edges) centre += place[e] / static_cast<double>(edges.size());
        const auto hub = static_cast<std::uint32_t>(mesh_.position_world.size());
        mesh_.position_world.push_back(centre);
        for (std::size_t i = 0; i < edges.size(); ++i)
            mesh_.triangles.push_back({vertex[edges[(i + 1) % edges.size()]], vertex[edges[i]], hub});
    }

    const Lattice& lattice_;
    const BrickList& bricks_;
    const BrickSource& source_;
    MeshCounts& counts_;
    BrickCrossings crossings_, values_;
    std::vector<std::uint32_t> vertex_;
    SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh marchBricks(const Lattice& lattice, const BrickList& bricks, const BrickSource& source,
                        MeshCounts& counts) {
    return MarchingCubes(lattice, bricks, source, counts).run();
}

SurfaceMesh marchingCubes(const MeshRequest& request, MeshCounts& counts) {
    const TapeAt tape(request.tape, request.lattice, request.bound_holds);
    const BrickList bricks = findBricks(request.tape, request.lattice, request.bound_holds);
    SurfaceMesh mesh =
        marchBricks(request.lattice, bricks, TapeBricks(request.lattice, bricks, tape), counts);
    findMaterials(tape, mesh);
    if (request.attributes) findNormals(tape, mesh);
    return mesh;
}

}  // namespace edgewise::sdf
