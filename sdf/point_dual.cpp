#include "sdf/point_dual.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <unordered_map>

#include "sdf/held_in_cell.h"
#include "sdf/mesh_cell.h"
#include "sdf/mesh_embedding.h"
#include "sdf/point_slopes.h"
#include "sdf/scene_error.h"

namespace edgewise::sdf {
namespace {

constexpr int kPlaces = kBrickCells * kBrickCells * kBrickCells;
/// As mesh_feature's: of eigenvalues; rounds of planes nearer to a sharp edge, and how much nearer; of a
/// cell's side, how far off the surface what is found may be.
constexpr double kCutoff = 0.002, kNearer = 0.1, kOnSurface = 0.01;
constexpr int kRefinements = 3, kNewtonSteps = 3, kMendings = 8;
/// Differences within so many reaches of a sharp edge see both of its sides.
constexpr double kClear = 2.0;
/// Of a cell's side: vertices that are held in it are kept so far from its faces.
constexpr double kRim = 0.02;
/// Of a cell's side: vertices of different cells nearer than that would be the same.
constexpr double kApart = 0.05;

/// A part of the surface in a cell.
struct Loop {
    glm::ivec3 cell;  ///< of the lattice
    std::uint32_t first_plane = 0, planes = 0;
    glm::dvec3 middle{0.0}, place{0.0};
    int rank = 1;  ///< as PlanesPoint's
};

class PointDual {
  public:
    PointDual(const PointField& field, const Lattice& lattice, const PointBricks& bricks)
        : field_(field), lattice_(lattice), bricks_(bricks), reach_(slopeReach(field, lattice)) {}

    SurfaceMesh run(std::uint64_t& cells) {
        around_.assign(bricks_.crossings().size(), {kNoBrick, kNoBrick, kNoBrick, kNoBrick});
        outward_.resize(around_.size());
        for (std::size_t b = 0; b < bricks_.list().bricks.size(); ++b) takeBrick(b, cells);
        findFeatures();
        settleSmooth();
        placeVertices();
        addTriangles();
        for (int round = 0; round < kMendings && mend(); ++round) addTriangles();
        return std::move(mesh_);
    }

  private:
    void takeBrick(std::size_t b, std::uint64_t& cells) {
        bricks_.readValues(b, values_);
        const glm::ivec3 first = bricks_.list().bricks[b].first / kUnits;
        for (int n = 0; n < kPlaces; ++n) {
            const glm::ivec3 place(n % kBrickCells, n / kBrickCells % kBrickCells,
                                   n / (kBrickCells * kBrickCells));
            if (!values_.crosses(place)) continue;
            ++cells;
            takeCell(first + place, place);
        }
    }

    void takeCell(const glm::ivec3& cell, const glm::ivec3& place) {
        double values[kCellCorners];
        values_.cellValues(place, values);
        const CellLoops found = loopsOf(values);
        for (int n = 0; n < found.count; ++n) {
            Loop loop;
            loop.cell = cell, loop.first_plane = static_cast<std::uint32_t>(planes_.size());
            for (int edge = 0; edge < kCellEdges; ++edge)
                if (found.loop[edge] == n) takeEdge(cell, edgeEnds(edge), values);
            loop.planes = static_cast<std::uint32_t>(planes_.size()) - loop.first_plane;
            for (const TangentPlane& plane : planesOf(loop))
                loop.middle += plane.point / static_cast<double>(loop.planes);
            loop.place = loop.middle;
            loops_.push_back(loop);
        }
    }
    /// The loop that comes next is around it.
    void takeEdge(const glm::ivec3& cell, const EdgeEnds& edge, const double (&values)[kCellCorners]) {
        const std::uint32_t at = bricks_.crossingAt(cell + BrickCrossings::cornerOffset(edge.low), edge.axis);
        if (at == kNoBrick) throw SceneError("surface", "it was found where bounds say that there is none");
        const bool low_u = edge.low >> (edge.axis + 1) % 3 & 1, low_v = edge.low >> (edge.axis + 2) % 3 & 1;
        // Counter-clockwise about the axis, from the cell below along the next two axes.
        around_[at][low_v ? (low_u ? 0 : 1) : (low_u ? 3 : 2)] = static_cast<std::uint32_t>(loops_.size());
        outward_[at] = values[edge.low] < 0.0;
        const Crossing& crossing = bricks_.crossings()[at];
        planes_.push_back({crossing.place_world, crossing.normal_world});
    }
    std::span<const TangentPlane> planesOf(const Loop& loop) const {
        return std::span(planes_).subspan(loop.first_plane, loop.planes);
    }

    /// Loops whose planes meet in an edge or a corner; those are asked for again among planes nearer to it,
    /// as long as slopes can tell its sides.
    void findFeatures() {
        std::vector<std::size_t> sharp;
        for (std::size_t i = 0; i < loops_.size(); ++i)
            if (meet(loops_[i], planesOf(loops_[i]), loops_[i].middle)) sharp.push_back(i);
        for (int n = 0; n < kRefinements && !sharp.empty(); ++n) comeNearer(sharp);
        std::vector<glm::dvec3> places;
        for (const std::size_t i : sharp) places.push_back(loops_[i].place);
        const std::vector<double> off = field_.values(places);
        for (std::size_t k = 0; k < sharp.size(); ++k)
            if (std::abs(off[k]) > kOnSurface * lattice_.step * field_.lipschitz()) loops_[sharp[k]].rank = 1;
    }
    bool meet(Loop& loop, std::span<const TangentPlane> planes, const glm::dvec3& about) const {
        const PlanesPoint found = nearestToPlanes(planes, about, kCutoff);
        const bool sharp = found.rank > 1 && glm::distance(found.place, loop.middle) <= 2.0 * lattice_.step;
        loop.rank = sharp ? found.rank : 1;
        if (sharp) loop.place = found.place;
        return sharp;
    }
    void comeNearer(std::vector<std::size_t>& sharp) {
        std::vector<TangentPlane> near;
        for (const std::size_t i : sharp)
            for (const TangentPlane& plane : planesOf(loops_[i])) {
                const glm::dvec3 way = plane.point - loops_[i].place;
                const double length = glm::length(way),
                             part = std::max(kNearer, kClear * reach_ / std::max(length, 1e-300));
                near.push_back({loops_[i].place + part * way, plane.normal});
            }
        for (int step = 0; step < 2; ++step) makeTangent(field_, reach_, near);
        std::size_t begin = 0;
        std::erase_if(sharp, [&](std::size_t i) {
            Loop& loop = loops_[i];
            const auto own = std::span<const TangentPlane>(near).subspan(begin, loop.planes);
            begin += loop.planes;
            std::ranges::copy(own, planes_.begin() + loop.first_plane);
            return !meet(loop, own, loop.place);
        });
    }

    /// The others go to the surface from their loops' middles.
    void settleSmooth() {
        std::vector<glm::dvec3> places;
        for (const Loop& loop : loops_)
            if (loop.rank == 1) places.push_back(loop.middle);
        moveOnSurface(field_, reach_, kNewtonSteps, places);
        std::size_t next = 0;
        for (Loop& loop : loops_)
            if (loop.rank == 1) loop.place = places[next++];
    }

    /// In their cells; those on sharp edges also in one beside it, where no other is in the same place. What
    /// is held back is put on the surface.
    void placeVertices() {
        std::vector<std::size_t> beside;
        for (std::size_t i = 0; i < loops_.size(); ++i)
            (isIn(loops_[i]) ? settled_[keyOf(loops_[i].cell)] : beside).push_back(i);
        std::vector<std::size_t> held;
        for (const std::size_t i : beside) {
            const Loop& loop = loops_[i];
            const glm::ivec3 at = cellOf(loop), off = glm::abs(at - loop.cell);
            std::vector<std::size_t>& others = settled_[keyOf(at)];
            const bool free =
                loop.rank > 1 && std::max({off.x, off.y, off.z}) == 1 &&
                std::ranges::none_of(others, [&](std::size_t other) {
                    return glm::distance(loops_[other].place, loop.place) <= kApart * lattice_.step;
                });
            (free ? others : held).push_back(i);
        }
        hold(held);
        mesh_.position_world.clear();
        for (const Loop& loop : loops_) mesh_.position_world.push_back(loop.place);
    }
    /// In their cells, on the surface.
    void hold(const std::vector<std::size_t>& loops) {
        std::vector<glm::dvec3> places;
        for (const std::size_t i : loops) places.push_back(placeInCell(loops_[i]));
        moveOnSurface(field_, reach_, kNewtonSteps, places);
        for (std::size_t k = 0; k < loops.size(); ++k) {
            Loop& loop = loops_[loops[k]];
            loop.place = places[k], loop.rank = 1;
            loop.place = placeInCell(loop);
        }
    }
    /// Vertices on sharp edges go back, those out of their cells first, where triangles meet. False: there
    /// was nothing to do.
    bool mend() {
        std::vector<bool> doubtful;
        for (const Triangle& t : mesh_.triangles)
            doubtful.push_back(std::ranges::any_of(t, [&](std::uint32_t v) { return loops_[v].rank > 1; }));
        std::vector<std::size_t> guests, sharp;
        for (const auto& [a, b] : meetingPairs(mesh_.position_world, mesh_.triangles, doubtful))
            for (const std::uint32_t t : {a, b})
                for (const std::uint32_t v : mesh_.triangles[t]) {
                    if (loops_[v].rank > 1) sharp.push_back(v);
                    if (!isIn(loops_[v])) guests.push_back(v);
                }
        std::vector<std::size_t>& back = guests.empty() ? sharp : guests;
        std::ranges::sort(back);
        back.erase(std::unique(back.begin(), back.end()), back.end());
        hold(back);
        for (const std::size_t v : back) mesh_.position_world[v] = loops_[v].place;
        return !back.empty();
    }
    /// In its own cell or on its border: a face of the surface may lie along a plane of the lattice.
    bool isIn(const Loop& loop) const {
        const glm::dvec3 low = lattice_.corner(kUnits * loop.cell) - kRim * lattice_.step,
                         high = lattice_.corner(kUnits * (loop.cell + 1)) + kRim * lattice_.step;
        return glm::all(glm::greaterThanEqual(loop.place, low)) &&
               glm::all(glm::lessThanEqual(loop.place, high));
    }
    glm::ivec3 cellOf(const Loop& loop) const { return lattice_.unitAt(loop.place) / kUnits; }
    std::uint64_t keyOf(const glm::ivec3& cell) const {
        const glm::u64vec3 c(cell), count(lattice_.cells);
        return c.x + count.x * (c.y + count.y * c.z);
    }

    glm::dvec3 placeInCell(const Loop& loop) const {
        return heldInCell(lattice_.corner(kUnits * loop.cell), lattice_.corner(kUnits * (loop.cell + 1)),
                          kRim * lattice_.step, loop.middle, loop.place);
    }

    /// Of a polygon the diagonal is taken whose middle is nearer to the surface.
    void addTriangles() {
        mesh_.triangles.clear();
        std::vector<glm::dvec3> middles;
        const auto& p = mesh_.position_world;
        for (const std::array<std::uint32_t, 4>& around : around_) {
            for (const std::uint32_t v : around)
                if (v == kNoBrick)
                    throw SceneError("surface", "it was found where bounds say that there is none");
            for (int k = 0; k < 2; ++k) middles.push_back(0.5 * (p[around[k]] + p[around[k + 2]]));
        }
        const std::vector<double> off = field_.values(middles);
        for (std::size_t n = 0; n < around_.size(); ++n) {
            std::array<std::uint32_t, 4> v = around_[n];
            if (!outward_[n]) std::swap(v[1], v[3]);
            const bool other = std::abs(off[2 * n + 1]) < std::abs(off[2 * n]);
            if (other) std::rotate(v.begin(), v.begin() + 1, v.end());
            mesh_.triangles.push_back({v[0], v[1], v[2]});
            mesh_.triangles.push_back({v[0], v[2], v[3]});
        }
    }

    const PointField& field_;
    const Lattice& lattice_;
    const PointBricks& bricks_;
    const double reach_;
    BrickCrossings values_;
    std::vector<Loop> loops_;
    std::vector<TangentPlane> planes_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> settled_;  ///< by cell: loops' vertices in it
    std::vector<std::array<std::uint32_t, 4>> around_;  ///< by crossing: the four cells' loops
    std::vector<bool> outward_;                         ///< the outside is at the edge's upper end
    SurfaceMesh mesh_;
};

}  // namespace

SurfaceMesh dualOfPoints(const PointField& field, const Lattice& lattice, const PointBricks& bricks,
                         std::uint64_t& cells) {
    return PointDual(field, lattice, bricks).run(cells);
}

}  // namespace edgewise::sdf
