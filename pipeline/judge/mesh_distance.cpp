// Distances between a mesh and the surface of a field, both ways.
#include "pipeline/judge/mesh_quality.h"

#ifdef EDGEWISE_HAS_ORACLE
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "pipeline/judge/nearest_triangle.h"
#include "sdf/evaluate.h"
#include "sdf/mesh_attributes.h"
#include "sdf/mesh_crossings.h"
#endif

namespace edgewise {

#ifdef EDGEWISE_HAS_ORACLE
namespace {

constexpr int kNewtonSteps = 20, kBisections = 60;

/// Each thread's own.
using Found = tbb::enumerable_thread_specific<MeshDistance>;

MeshDistance joined(const Found& found) {
    MeshDistance all;
    for (const MeshDistance& part : found) {
        all.mesh_to_surface = std::max(all.mesh_to_surface, part.mesh_to_surface);
        all.mesh_spacing = std::max(all.mesh_spacing, part.mesh_spacing);
        all.worst_part = std::max(all.worst_part, part.worst_part);
        all.mesh_samples += part.mesh_samples, all.surface_samples += part.surface_samples;
        if (part.surface_to_mesh <= all.surface_to_mesh) continue;
        all.surface_to_mesh = part.surface_to_mesh, all.worst_on_surface = part.worst_on_surface;
    }
    return all;
}

/// How far along gradients the surface is: an upper bound of the distance, once the value is 0 there.
double toSurface(const sdf::TapeAt& tape, const glm::dvec3& from) {
    glm::dvec3 p = from;
    double value = 0.0;
    for (int step = 0; step < kNewtonSteps; ++step) {
        const sdf::ValueAndGradient at = sdf::gradientAt(tape(p), p);
        const double slope2 = glm::dot(at.gradient, at.gradient);
        value = at.value;
        if (!(slope2 > 0.0)) break;
        const glm::dvec3 next = p - at.gradient * (at.value / slope2);
        if (next == p) break;
        p = next;
    }
    return std::max(glm::distance(p, from), std::abs(value));
}

void meshToSurface(const sdf::SurfaceMesh& mesh, const sdf::TapeAt& tape, const sdf::MostOff* allowed,
                   Found& found) {
    tbb::parallel_for(std::size_t(0), mesh.triangles.size(), [&](std::size_t n) {
        MeshDistance& result = found.local();
        const sdf::Triangle& t = mesh.triangles[n];
        const glm::dvec3 &a = mesh.position_world[t[0]], &b = mesh.position_world[t[1]],
                         &c = mesh.position_world[t[2]];
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        result.mesh_spacing = std::max(result.mesh_spacing, longest / 3.0);
        for (const auto& w : kTrianglePlaces) {
            const glm::dvec3 p = w[0] * a + w[1] * b + w[2] * c;
            const double distance = toSurface(tape, p);
            result.mesh_to_surface = std::max(result.mesh_to_surface, distance);
            if (allowed)
                result.worst_part =
                    std::max(result.worst_part, distance / allowed->leastWithin(p, longest / 3.0));
        }
        result.mesh_samples += std::size(kTrianglePlaces);
    });
}

/// Where the surface crosses a segment, if the signs at its ends differ.
bool crossing(const sdf::TapeAt& tape, glm::dvec3 inside, glm::dvec3 outside, glm::dvec3& place) {
    const bool first = sdf::valueAt(tape(inside), inside) < 0.0,
               second = sdf::valueAt(tape(outside), outside) < 0.0;
    if (first == second) return false;
    if (second) std::swap(inside, outside);
    for (int step = 0; step < kBisections; ++step) {
        place = 0.5 * (inside + outside);
        (sdf::valueAt(tape(place), place) < 0.0 ? inside : outside) = place;
    }
    return true;
}

class SurfaceToMesh {
  public:
    SurfaceToMesh(const sdf::SurfaceMesh& mesh, const sdf::TapeAt& tape, const sdf::Lattice& lattice,
                  int per_cell, const sdf::MostOff* allowed)
        : nearest_(mesh), tape_(tape), lattice_(lattice), per_cell_(per_cell), allowed_(allowed) {}

    /// `seed`: of its lines.
    void brick(const sdf::Brick& brick, std::uint64_t seed, MeshDistance& result) const {
        std::mt19937_64 random(seed);
        constexpr int kSide = sdf::kBrickCells;
        for (int n = 0; n < kSide * kSide * kSide; ++n) {
            const glm::dvec3 low =
                lattice_.corner(brick.unitsOf(glm::ivec3(n % kSide, n / kSide % kSide, n / (kSide * kSide))));
            const glm::dvec3 centre = low + 0.5 * lattice_.step;
            const double value = sdf::valueAt(tape_(centre), centre);
            if (std::abs(value) > 1.75 * lattice_.step * slope_) continue;
            for (int line = 0; line < per_cell_; ++line) ask(low, random, result);
        }
    }
    void slope(double most) { slope_ = std::max(most, 1e-3); }

  private:
    /// On a line of about a cell's length, its middle anywhere in the cell.
    void ask(const glm::dvec3& low, std::mt19937_64& random, MeshDistance& result) const {
        std::uniform_real_distribution<double> at(0.0, 1.0), side(-1.0, 1.0);
        const glm::dvec3 middle = low + lattice_.step * glm::dvec3(at(random), at(random), at(random));
        glm::dvec3 along(side(random), side(random), side(random));
        along *= lattice_.step / std::max(glm::length(along), 0.1);
        glm::dvec3 place;
        if (!crossing(tape_, middle - along, middle + along, place)) return;
        ++result.surface_samples;
        const double distance = nearest_.distance(place);
        if (allowed_) result.worst_part = std::max(result.worst_part, distance / allowed_->at(place));
        if (distance <= result.surface_to_mesh) return;
        result.surface_to_mesh = distance;
        result.worst_on_surface = place;
    }

    const NearestTriangle nearest_;
    const sdf::TapeAt& tape_;
    const sdf::Lattice& lattice_;
    const int per_cell_;
    const sdf::MostOff* const allowed_;
    double slope_ = 1.0;
};

}  // namespace

std::optional<MeshDistance> distanceOf(const sdf::SurfaceMesh& mesh, const sdf::Tape& tape,
                                       const sdf::Lattice& lattice, bool bound_holds, int per_cell,
                                       const sdf::MostOff* allowed) {
    Found found;
    const sdf::TapeAt short_tape(tape, lattice, bound_holds);
    const sdf::BrickList bricks = sdf::findBricks(tape, lattice, bound_holds);
    meshToSurface(mesh, short_tape, allowed, found);
    SurfaceToMesh ask(mesh, short_tape, lattice, per_cell, allowed);
    ask.slope(bound_holds ? tape.lipschitz : 1e6);
    tbb::parallel_for(std::size_t(0), bricks.bricks.size(),
                      [&](std::size_t b) { ask.brick(bricks.bricks[b], b, found.local()); });
    MeshDistance result = joined(found);
    result.surface_spacing = std::sqrt(qualityOf(mesh).area / std::max<double>(1.0, result.surface_samples));
    return result;
}
#else
std::optional<MeshDistance> distanceOf(const sdf::SurfaceMesh&, const sdf::Tape&, const sdf::Lattice&, bool,
                                       int, const sdf::MostOff*) {
    return std::nullopt;
}
#endif

}  // namespace edgewise
