#include "sdf/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"
#include "sdf/mesh_feature.h"
#include "sdf/surface_distance.h"
#include "sdf/triangle_tree.h"

namespace edgewise::sdf {
namespace {

constexpr int kPlaces = kBrickCells * kBrickCells * kBrickCells;
/// Of a cell's side: a place counts as one on the surface.
constexpr double kOnSurface = 1e-6;

class Check {
  public:
    Check(const SurfaceMesh& mesh, const MeshRequest& request, const TapeAt& tape, const DualComplex& complex,
          const SharpCells& sharp, const MeshLimits& limits)
        : mesh_(mesh),
          request_(request),
          lattice_(request.lattice),
          complex_(complex),
          sharp_(sharp),
          limits_(limits),
          tape_(tape),
          tree_(mesh.position_world, mesh.triangles) {}

    std::vector<PlaceOff> run() {
        for (const Triangle& t : mesh_.triangles) takeTriangle(t);
        for (const DualPolygon& p : complex_.polygons)
            if (!p.made) takePlace(p.brick, p.crossing.point);
        for (std::uint32_t b = 0; b < complex_.bricks.bricks.size(); ++b)
            if (!complex_.bricks.bricks[b].divided) takeBrick(b);
        return std::move(off_);
    }

  private:
    /// The least within so far of a place.
    double limitAt(const glm::dvec3& p, double radius) const {
        const MeshLimits limits = limits_.within(p, radius);
        return sharp_.at(p) ? limits.sharp : limits.smooth;
    }

    /// What a cell's size does to the mesh is about as large as it.
    void add(const glm::dvec3& p, std::uint32_t b, double times_limit) {
        const int halved = times_limit > 4.0 ? 3 : times_limit > 2.0 ? 2 : 1;
        off_.push_back({p, complex_.bricks.bricks[b].level, std::min(halved, kMostHalved)});
    }
    std::uint32_t brickAt(const glm::dvec3& p) const {
        return complex_.bricks.leafAt(lattice_, lattice_.unitAt(p)).brick;
    }

    void takeTriangle(const Triangle& t) {
        const auto at = [&](int i) { return mesh_.position_world[t[i % 3]]; };
        const glm::dvec3 centre = (at(0) + at(1) + at(2)) / 3.0;
        takeMeshPlace(centre, glm::distance(centre, at(0)), t);
        for (int i = 0; i < 3; ++i)
            if (t[i] < t[(i + 1) % 3])
                takeMeshPlace(0.5 * (at(i) + at(i + 1)), 0.5 * glm::distance(at(i), at(i + 1)), t);
    }
    void takeMeshPlace(const glm::dvec3& p, double radius, const Triangle& t) {
        const std::uint32_t b = brickAt(p);
        const double limit = limitAt(p, radius), off = distanceBy(tape_, p, limit);
        if (off <= limit) return;
        if (b != kNoBrick) return add(p, b, off / limit);
        for (const std::uint32_t v : t)
            if (const glm::dvec3& q = mesh_.position_world[v]; brickAt(q) != kNoBrick)
                add(q, brickAt(q), off / limit);
    }
    void takePlace(std::uint32_t b, const glm::dvec3& p) {
        const double limit = limitAt(p, 0.0);
        if (tree_.near(p, limit)) return;
        add(p, b, tree_.near(p, 2.0 * limit) ? 1.0 : tree_.near(p, 4.0 * limit) ? 3.0 : 5.0);
    }

    void takeBrick(std::uint32_t b) {
        const Brick& brick = complex_.bricks.bricks[b];
        const double side = lattice_.step / (1 << brick.level);
        const double reach =
            0.5 * std::sqrt(3.0) * side * (request_.bound_holds ? request_.tape.lipschitz : 1e6);
        for (int begin = 0; begin < kPlaces; begin += kPointLanes) {
            LanePoints centres;
            for (int lane = 0; lane < kPointLanes; ++lane) {
                const glm::dvec3 p = centreOf(brick, begin + lane, side);
                for (int axis = 0; axis < 3; ++axis) centres.axis[axis][lane] = p[axis];
            }
            double values[kPointLanes];
            laneValues(brick.tape, centres, values);
            for (int lane = 0; lane < kPointLanes; ++lane) {
                const auto place = static_cast<std::size_t>(begin + lane);
                const bool asked = sharp_.cell(b, place) || !complex_.passed[b][place];
                if (asked && std::abs(values[lane]) <= reach)
                    takeCell(b, centreOf(brick, begin + lane, side), side);
            }
        }
    }
    glm::dvec3 centreOf(const Brick& brick, int n, double side) const {
        return lattice_.corner(brick.unitsOf(
                   {n % kBrickCells, n / kBrickCells % kBrickCells, n / (kBrickCells * kBrickCells)})) +
               0.5 * side;
    }
    void takeCell(std::uint32_t b, const glm::dvec3& centre, double side) {
        const glm::dvec3 p = onSurface(tape_, centre), off = glm::abs(p - centre);
        if (std::max({off.x, off.y, off.z}) > 0.5 * side) return;
        if (std::abs(valueAt(tape_(p), p)) <= kOnSurface * side) takePlace(b, p);
    }

    const SurfaceMesh& mesh_;
    const MeshRequest& request_;
    const Lattice& lattice_;
    const DualComplex& complex_;
    const SharpCells& sharp_;
    const MeshLimits limits_;
    const TapeAt& tape_;
    const TriangleTree tree_;
    std::vector<PlaceOff> off_;
};

}  // namespace

std::vector<PlaceOff> placesOff(const SurfaceMesh& mesh, const MeshRequest& request,
                                const TapeAt& tape, const DualComplex& complex, const SharpCells& sharp,
                                const MeshLimits& limits) {
    return Check(mesh, request, tape, complex, sharp, limits).run();
}

std::size_t divideAt(const std::vector<PlaceOff>& places, const MeshRequest& request, std::size_t most_bricks,
                     BrickList& bricks) {
    std::size_t count = 0;
    for (const PlaceOff& off : places) {
        const glm::ivec3 unit = request.lattice.unitAt(off.place_world);
        const int level = std::min(off.level + off.halved, kMostLevels);
        for (;;) {
            const BrickList::Leaf leaf = bricks.leafAt(request.lattice, unit);
            if (leaf.brick == kNoBrick || leaf.level >= level || bricks.bricks.size() >= most_bricks) break;
            divideBrick(request.tape, request.lattice, request.bound_holds, leaf.brick, bricks);
            ++count;
        }
    }
    return count;
}

}  // namespace edgewise::sdf
