// Distances between a mesh and the surface of a field that is asked at many points at once, both ways.
#include "pipeline/judge/mesh_quality.h"

#ifdef EDGEWISE_HAS_ORACLE
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "pipeline/judge/nearest_triangle.h"
#include "sdf/point_bricks.h"
#include "sdf/point_slopes.h"
#endif

namespace edgewise {

#ifdef EDGEWISE_HAS_ORACLE
namespace {

constexpr int kNewtonSteps = 6;
constexpr std::size_t kTrianglesABatch = std::size_t(1) << 14, kBricksABatch = 256;
constexpr int kCells = sdf::kBrickCells * sdf::kBrickCells * sdf::kBrickCells;

class PointDistance {
  public:
    PointDistance(const sdf::SurfaceMesh& mesh, const sdf::PointField& field, const sdf::Lattice& lattice,
                  int per_cell, const sdf::MostOff* allowed)
        : mesh_(mesh),
          field_(field),
          lattice_(lattice),
          per_cell_(per_cell),
          allowed_(allowed),
          reach_(slopeReach(field, lattice)),
          nearest_(mesh) {}

    MeshDistance run() {
        for (std::size_t t = 0; t < mesh_.triangles.size(); t += kTrianglesABatch)
            meshToSurface(t, std::min(mesh_.triangles.size(), t + kTrianglesABatch));
        const sdf::NearBricks near = bricksNear(field_, lattice_);
        slope_ = near.bound_holds ? field_.lipschitz() : 1e6;
        for (std::size_t b = 0; b < near.bricks.size(); b += kBricksABatch)
            surfaceToMesh(std::span(near.bricks).subspan(b, std::min(kBricksABatch, near.bricks.size() - b)),
                          b);
        result_.surface_spacing =
            std::sqrt(qualityOf(mesh_).area / std::max<double>(1.0, result_.surface_samples));
        return result_;
    }

  private:
    /// How far along slopes the surface is: an upper bound of the distance, once the value is 0 there.
    void meshToSurface(std::size_t begin, std::size_t end) {
        std::vector<glm::dvec3> from, to;
        std::vector<double> spacing;
        for (std::size_t n = begin; n < end; ++n) {
            const sdf::Triangle& t = mesh_.triangles[n];
            const glm::dvec3 &a = mesh_.position_world[t[0]], &b = mesh_.position_world[t[1]],
                             &c = mesh_.position_world[t[2]];
            spacing.push_back(std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)}) /
                              3.0);
            for (const auto& w : kTrianglePlaces) from.push_back(w[0] * a + w[1] * b + w[2] * c);
        }
        to = from;
        moveOnSurface(field_, reach_, kNewtonSteps, to);
        const std::vector<double> left = field_.values(to);
        for (std::size_t i = 0; i < from.size(); ++i) {
            const double distance = std::max(glm::distance(from[i], to[i]), std::abs(left[i])),
                         around = spacing[i / std::size(kTrianglePlaces)];
            result_.mesh_to_surface = std::max(result_.mesh_to_surface, distance);
            result_.mesh_spacing = std::max(result_.mesh_spacing, around);
            if (allowed_)
                result_.worst_part =
                    std::max(result_.worst_part, distance / allowed_->leastWithin(from[i], around));
        }
        result_.mesh_samples += from.size();
    }

    /// Where lines of about a cell's length, their middles anywhere in cells by the surface, cross it.
    void surfaceToMesh(std::span<const glm::ivec3> bricks, std::uint64_t seed) {
        std::vector<glm::dvec3> lows, centres;
        for (const glm::ivec3& brick : bricks)
            for (int n = 0; n < kCells; ++n) {
                constexpr int kSide = sdf::kBrickCells;
                const glm::ivec3 cell(n % kSide, n / kSide % kSide, n / (kSide * kSide));
                lows.push_back(lattice_.corner(sdf::kUnits * (kSide * brick + cell)));
                centres.push_back(lows.back() + 0.5 * lattice_.step);
            }
        const std::vector<double> values = field_.values(centres);
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> at(0.0, 1.0), side(-1.0, 1.0);
        std::vector<glm::dvec3> one, other;
        for (std::size_t i = 0; i < lows.size(); ++i) {
            if (std::abs(values[i]) > 1.75 * lattice_.step * slope_) continue;
            for (int line = 0; line < per_cell_; ++line) {
                const glm::dvec3 middle =
                    lows[i] + lattice_.step * glm::dvec3(at(random), at(random), at(random));
                glm::dvec3 along(side(random), side(random), side(random));
                along *= lattice_.step / std::max(glm::length(along), 0.1);
                one.push_back(middle - along), other.push_back(middle + along);
            }
        }
        judge(crossed(std::move(one), std::move(other)));
    }

    /// Where the lines whose ends differ in sign cross the surface: halved as long as numbers tell.
    std::vector<glm::dvec3> crossed(std::vector<glm::dvec3> one, std::vector<glm::dvec3> other) const {
        const std::vector<double> at_one = field_.values(one), at_other = field_.values(other);
        std::vector<glm::dvec3> inside, outside, middle;
        for (std::size_t i = 0; i < one.size(); ++i) {
            if ((at_one[i] < 0.0) == (at_other[i] < 0.0)) continue;
            inside.push_back(at_one[i] < 0.0 ? one[i] : other[i]);
            outside.push_back(at_one[i] < 0.0 ? other[i] : one[i]);
        }
        middle.resize(inside.size());
        for (double part = 1.0; part > field_.rounding(); part *= 0.5) {
            for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = 0.5 * (inside[i] + outside[i]);
            const std::vector<double> values = field_.values(middle);
            for (std::size_t i = 0; i < middle.size(); ++i)
                (values[i] < 0.0 ? inside : outside)[i] = middle[i];
        }
        return middle;
    }

    void judge(const std::vector<glm::dvec3>& places) {
        std::vector<double> distances(places.size());
        tbb::parallel_for(std::size_t(0), places.size(),
                          [&](std::size_t i) { distances[i] = nearest_.distance(places[i]); });
        for (std::size_t i = 0; i < places.size(); ++i) {
            ++result_.surface_samples;
            if (allowed_)
                result_.worst_part = std::max(result_.worst_part, distances[i] / allowed_->at(places[i]));
            if (distances[i] <= result_.surface_to_mesh) continue;
            result_.surface_to_mesh = distances[i], result_.worst_on_surface = places[i];
        }
    }

    const sdf::SurfaceMesh& mesh_;
    const sdf::PointField& field_;
    const sdf::Lattice& lattice_;
    const int per_cell_;
    const sdf::MostOff* const allowed_;
    const double reach_;
    const NearestTriangle nearest_;
    double slope_ = 1.0;
    MeshDistance result_;
};

}  // namespace

std::optional<MeshDistance> distanceOf(const sdf::SurfaceMesh& mesh, const sdf::PointField& field,
                                       const sdf::Lattice& lattice, int per_cell,
                                       const sdf::MostOff* allowed) {
    return PointDistance(mesh, field, lattice, per_cell, allowed).run();
}
#else
std::optional<MeshDistance> distanceOf(const sdf::SurfaceMesh&, const sdf::PointField&, const sdf::Lattice&,
                                       int, const sdf::MostOff*) {
    return std::nullopt;
}
#endif

}  // namespace edgewise
