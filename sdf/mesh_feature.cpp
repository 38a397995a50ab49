#include "sdf/mesh_feature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"

namespace edgewise::sdf {
namespace {

/// Of eigenvalues: normals of two sides that differ by 5 degrees have 0.0019.
constexpr double kCutoff = 0.002;
constexpr int kRefinements = 3, kNewtonSteps = 4;
constexpr double kNearer = 0.1;
/// More than one cell's.
constexpr std::size_t kManyPlanes = 12;
/// Of a cell's side: planes meet exactly; a point is on the surface.
constexpr double kMeet = 1e-10, kOnSurface = 1e-4;

TangentPlane tangentPlane(const TapeAt& tape, glm::dvec3 p, const glm::dvec3& other_normal) {
    glm::dvec3 normal = other_normal;
    for (int step = 0; step < 2; ++step) {
        const ValueAndGradient at = gradientAt(tape(p), p);
        const double slope2 = glm::dot(at.gradient, at.gradient);
        if (!(slope2 > 0.0) || !std::isfinite(slope2)) break;
        normal = at.gradient / std::sqrt(slope2);
        p -= at.gradient * (at.value / slope2);
    }
    return {p, normal};
}

/// Two whose normals differ about as much as any do.
std::array<std::size_t, 2> mostDifferent(std::span<const TangentPlane> planes) {
    const auto farthestFrom = [&](std::size_t from) {
        std::size_t farthest = 0;
        for (std::size_t i = 1; i < planes.size(); ++i)
            if (glm::dot(planes[i].normal, planes[from].normal) <
                glm::dot(planes[farthest].normal, planes[from].normal))
                farthest = i;
        return farthest;
    };
    const std::size_t one = farthestFrom(0);
    return {one, farthestFrom(one)};
}

/// Of two planes alone: their matrix's second eigenvalue is below the cutoff.
bool areOne(const TangentPlane& a, const TangentPlane& b) {
    const double cosine = std::abs(glm::dot(a.normal, b.normal));
    return 1.0 - cosine <= kCutoff * (1.0 + cosine);
}

}  // namespace

glm::dvec3 onSurface(const TapeAt& tape, const glm::dvec3& from) {
    glm::dvec3 p = from;
    for (int step = 0; step < kNewtonSteps; ++step) {
        const ValueAndGradient at = gradientAt(tape(p), p);
        const double slope2 = glm::dot(at.gradient, at.gradient);
        if (!(slope2 > 0.0) || !std::isfinite(slope2) || at.value == 0.0) break;
        const glm::dvec3 move = at.gradient * (at.value / slope2);
        p -= move;
        if (glm::dot(move, move) < 1e-28 * glm::dot(p, p)) break;
    }
    return p;
}

FeaturePoint featurePoint(const TapeAt& tape, std::span<const TangentPlane> given, const glm::dvec3& about,
                          double step) {
    std::array<TangentPlane, kMostPlanes> planes;
    std::copy(given.begin(), given.end(), planes.begin());
    const auto smooth = [&] { return FeaturePoint{onSurface(tape, about), 1}; };
    const std::span<const TangentPlane> own(planes.data(), given.size());
    PlanesPoint found = nearestToPlanes(own, about, kCutoff);
    for (int n = 0;; ++n) {
        if (found.rank < 2 || glm::distance(found.place, about) > 2.0 * step) return smooth();
        const double off = std::abs(valueAt(tape(found.place), found.place));
        if (found.residual <= kMeet * step && off <= kMeet * step) break;
        if (n == kRefinements) {
            if (off > kOnSurface * step) return smooth();
            break;
        }
        const auto nearer = [&](std::size_t i) {
            return tangentPlane(tape, found.place + kNearer * (planes[i].point - found.place),
                                planes[i].normal);
        };
        if (n == 0 && given.size() > kManyPlanes) {
            // Most are smooth: there, the two that differ most agree as they come nearer.
            const auto [i, j] = mostDifferent(own);
            if (areOne(nearer(i), nearer(j))) return smooth();
        }
        for (std::size_t i = 0; i < given.size(); ++i) planes[i] = nearer(i);
        found = nearestToPlanes(own, found.place, kCutoff);
    }
    return {found.place, found.rank};
}

}  // namespace edgewise::sdf
