#include "sdf/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"
#include "sdf/mesh_feature.h"
#include "sdf/triangle_tree.h"

namespace edgewise::sdf {
namespace {

constexpr int kPlaces = kBrickCells * kBrickCells * kBrickCells;
/// Of a cell's side: a place counts as one on the surface.
constexpr double kOnSurface = 1e-6;

class Check {
  public:
    Check(const SurfaceMesh& mesh, const MeshRequest& request, const DualComplex& complex,
          const SharpBricks& sharp, const MeshLimits& limits)
        : mesh_(mesh),
          request_(request),
          lattice_(request.lattice),
          complex_(complex),
          sharp_(sharp),
          limits_(limits),
          tape_(request.tape, lattice_, complex.bricks),
          tree_(mesh.position_world, mesh.triangles),
          off_(complex.bricks.bricks.size(), false) {}

    std::vector<std::uint32_t> run() {
        for (const Triangle& t : mesh_.triangles) takeTriangle(t);
        for (const DualPolygon& p : complex_.polygons) takePlace(p.brick, p.crossing.point);
        for (std::uint32_t b = 0; b < off_.size(); ++b)
            if (!complex_.bricks.bricks[b].divided) takeBrick(b);
        std::vector<std::uint32_t> found;
        for (std::uint32_t b = 0; b < off_.size(); ++b)
            if (off_[b]) found.push_back(b);
        return found;
    }

  private:
    double limitOf(std::uint32_t b) const { return sharp_[b] ? limits_.sharp : limits_.smooth; }

    std::uint32_t brickAt(const glm::dvec3& p) const {
        return complex_.bricks.leafAt(lattice_, lattice_.unitAt(p)).brick;
    }

    void takeTriangle(const Triangle& t) {
        const auto at = [&](int i) { return mesh_.position_world[t[i % 3]]; };
        takeMeshPlace((at(0) + at(1) + at(2)) / 3.0, t);
        for (int i = 0; i < 3; ++i)
            if (t[i] < t[(i + 1) % 3]) takeMeshPlace(0.5 * (at(i) + at(i + 1)), t);
    }
    void takeMeshPlace(const glm::dvec3& p, const Triangle& t) {
        const std::uint32_t b = brickAt(p);
        if (b != kNoBrick) {
            if (!off_[b] && surfaceIsFar(tape_(p), p, limitOf(b))) off_[b] = true;
            return;
        }
        if (!surfaceIsFar(tape_(p), p, limits_.sharp)) return;
        for (const std::uint32_t v : t)
            if (const std::uint32_t other = brickAt(mesh_.position_world[v]); other != kNoBrick)
                off_[other] = true;
    }
    /// By the value, which is at most the bound times the distance, and by the slope.
    bool surfaceIsFar(const TapeView& tape, const glm::dvec3& p, double limit) const {
        const double value = std::abs(valueAt(tape, p));
        if (request_.bound_holds && value > limit * request_.tape.lipschitz) return true;
        if (value < 0.1 * limit) return false;
        const double slope = glm::length(gradientAt(tape, p).gradient);
        return value > limit * std::max(slope, 1e-3);
    }

    void takePlace(std::uint32_t b, const glm::dvec3& p) {
        if (!off_[b] && !tree_.near(p, limitOf(b))) off_[b] = true;
    }

    void takeBrick(std::uint32_t b) {
        const Brick& brick = complex_.bricks.bricks[b];
        const double side = lattice_.step / (1 << brick.level);
        const double reach = 0.5 * std::sqrt(3.0) * side * (request_.bound_holds ? request_.tape.lipschitz : 1e6);
        for (int begin = 0; begin < kPlaces && !off_[b]; begin += kPointLanes) {
            LanePoints centres;
            for (int lane = 0; lane < kPointLanes; ++lane) {
                const glm::dvec3 p = centreOf(brick, begin + lane, side);
                for (int axis = 0; axis < 3; ++axis) centres.axis[axis][lane] = p[axis];
            }
            double values[kPointLanes];
            laneValues(brick.tape, centres, values);
            for (int lane = 0; lane < kPointLanes; ++lane) {
                const bool asked = sharp_[b] || !complex_.passed[b][static_cast<std::size_t>(begin + lane)];
                if (asked && std::abs(values[lane]) <= reach) takeCell(b, centreOf(brick, begin + lane, side), side);
            }
        }
    }
    glm::dvec3 centreOf(const Brick& brick, int n, double side) const {
        return lattice_.corner(brick.unitsOf({n % kBrickCells, n / kBrickCells % kBrickCells,
                                              n / (kBrickCells * kBrickCells)})) +
               0.5 * side;
    }
    void takeCell(std::uint32_t b, const glm::dvec3& centre, double side) {
        const TapeView& tape = complex_.bricks.bricks[b].tape;
        const glm::dvec3 p = onSurface(tape, centre), off = glm::abs(p - centre);
        if (std::max({off.x, off.y, off.z}) > 0.5 * side) return;
        if (std::abs(valueAt(tape, p)) <= kOnSurface * side) takePlace(b, p);
    }

    const SurfaceMesh& mesh_;
    const MeshRequest& request_;
    const Lattice& lattice_;
    const DualComplex& complex_;
    const SharpBricks& sharp_;
    const MeshLimits limits_;
    const TapeAt tape_;
    const TriangleTree tree_;
    std::vector<bool> off_;
};

}  // namespace

std::vector<std::uint32_t> bricksOff(const SurfaceMesh& mesh, const MeshRequest& request,
                                     const DualComplex& complex, const SharpBricks& sharp,
                                     const MeshLimits& limits) {
    return Check(mesh, request, complex, sharp, limits).run();
}

}  // namespace edgewise::sdf
