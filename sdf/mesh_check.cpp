#include "sdf/mesh_check.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "sdf/evaluate.h"
#include "sdf/mesh_feature.h"
#include "sdf/surface_distance.h"
#include "sdf/triangle_tree.h"

namespace edgewise::sdf {
namespace {

constexpr std::size_t kChunk = 64;
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
        std::vector<PlaceOff> all;
        // By chunks, whose finds are joined in order: as one thread would find them.
        const auto each = [&](std::size_t count, const auto& take) {
            std::vector<std::vector<PlaceOff>> parts((count + kChunk - 1) / kChunk);
            tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t part) {
                for (std::size_t n = part * kChunk; n < std::min(count, (part + 1) * kChunk); ++n) take(n);
                parts[part].swap(off_.local());
            });
            for (const std::vector<PlaceOff>& part : parts) all.insert(all.end(), part.begin(), part.end());
        };
        each(mesh_.triangles.size(), [&](std::size_t t) { takeTriangle(mesh_.triangles[t]); });
        each(complex_.polygons.size(), [&](std::size_t p) {
            const DualPolygon& polygon = complex_.polygons[p];
            if (!polygon.made) takePlace(polygon.brick, polygon.crossing.point);
        });
        each(complex_.bricks.bricks.size(), [&](std::size_t b) {
            if (!complex_.bricks.bricks[b].divided) takeBrick(static_cast<std::uint32_t>(b));
        });
        return all;
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
        off_.local().push_back({p, complex_.bricks.bricks[b].level, std::min(halved, kMostHalved),
                                sharp_.at(p) ? 1.0 : times_limit});
    }
    std::uint32_t brickAt(const glm::dvec3& p) const {
        return complex_.bricks.leafAt(lattice_, lattice_.unitAt(p)).brick;
    }

    void takeTriangle(const Triangle& t) {
        const auto at = [&](int i) { return mesh_.position_world[t[i % 3]]; };
        const glm::dvec3 centre = (at(0) + at(1) + at(2)) / 3.0;
        takeMeshPlace(centre,
                      std::max({glm::distance(centre, at(0)), glm::distance(centre, at(1)),
                                glm::distance(centre, at(2))}),
                      t);
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
    tbb::enumerable_thread_specific<std::vector<PlaceOff>> off_;
};

}  // namespace

std::vector<PlaceOff> placesOff(const SurfaceMesh& mesh, const MeshRequest& request, const TapeAt& tape,
                                const DualComplex& complex, const SharpCells& sharp,
                                const MeshLimits& limits) {
    return Check(mesh, request, tape, complex, sharp, limits).run();
}

double bricksNeeded(const std::vector<PlaceOff>& places, const MeshRequest& request,
                    const BrickList& bricks) {
    std::map<std::uint32_t, double> worst;
    for (const PlaceOff& off : places) {
        double& times = worst[bricks.leafAt(request.lattice, request.lattice.unitAt(off.place_world)).brick];
        times = std::max(times, off.times_limit);
    }
    double needed = static_cast<double>(bricks.bricks.size());
    for (const auto& [brick, times] : worst) {
        if (brick == kNoBrick) continue;
        const double halved = std::max(std::ceil(0.5 * std::log2(times)) - 1.0, 0.0);
        if (bricks.bricks[brick].level + halved > kMostLevels) return HUGE_VAL;
        needed += std::exp2(2.0 * halved) - 1.0;
    }
    return needed;
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
