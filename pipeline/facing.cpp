#include "pipeline/facing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace edgewise {
namespace {

double largest(const glm::dvec3& v) {
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

/// Of |m p + t|, by row, where |p| <= reach.
glm::dvec3 imageReach(const glm::dmat4& m, const glm::dvec3& reach) {
    glm::dvec3 sum = glm::abs(glm::dvec3(m[3]));
    for (int k = 0; k < 3; ++k) sum += glm::abs(glm::dvec3(m[k])) * reach[k];
    return sum;
}

glm::dvec3 worldReach(const Geometry& geometry) {
    if (!geometry.world_from_file) {
        glm::dvec3 reach(0.0);
        for (const glm::dvec3& p : geometry.position_world) reach = glm::max(reach, glm::abs(p));
        return reach;
    }
    glm::vec3 reach(0.0f);
    for (const glm::vec3& p : geometry.position_file) reach = glm::max(reach, glm::abs(p));
    return imageReach(*geometry.world_from_file, glm::dvec3(reach));
}

}  // namespace

/// A map sums four products, each sum off by at most 4 u of the sum of magnitudes (u = 2^-53); the world's
/// error is mapped on. 32 u of the largest sum is more than twice both.
Facing::Facing(const Scene& scene, const glm::dmat4& camera_from_world, const ScreenMap& map)
    : perspective_(map.perspective), error_(scene.geometry.size()) {
    const glm::dvec2 from_principal = ((map.anchorPx() - map.offset_px) - map.whole_px) - map.fraction_px;
    const double reach = std::fabs(from_principal.x) + std::fabs(from_principal.y);
    steepest_ = 2.0 * (1.0 + (1.0 + reach) / map.scale_px);
    tbb::parallel_for(std::size_t{0}, error_.size(), [&](std::size_t g) {
        error_[g] = 0x1p-48 * largest(imageReach(camera_from_world, worldReach(scene.geometry[g])));
    });
}

/// n = (b - a) x (c - a), d = n . a. With corners off by e, at most M, and differences at most L, off by
/// D = 2 e + u L: n is off by at most N = 4 L D + 2 D^2 + 4 u L^2, d by 3 (N (M + e) + 2 L^2 e) + 24 u L^2 M;
/// the bounds are doubled for their own rounding. What is far from over- and underflow is far from it in
/// double-double too.
int Facing::side(std::uint32_t geometry, const glm::dvec3& a, const glm::dvec3& b,
                 const glm::dvec3& c) const {
    constexpr double u = 0x1p-53, kSmallest = 0x1p-600, kLargest = 0x1p200, kSteepest = 0x1p800;
    const glm::dvec3 p = b - a, q = c - a, n = glm::cross(p, q);
    const double e = error_[geometry], L = std::max(largest(p), largest(q)), M = largest(a);
    const double D = 2.0 * e + u * L, N = 4.0 * L * D + 2.0 * D * D + 4.0 * u * L * L;
    const double d = (n.x * a.x + n.y * a.y) + n.z * a.z;
    const double d_error = 3.0 * (N * (M + e) + 2.0 * L * L * e) + 24.0 * u * L * L * M;
    const double divisor = perspective_ ? -d : n.z, error = 2.0 * (perspective_ ? d_error : N);
    const double size = 2.0 * (largest(n) + N) + (perspective_ ? 0.0 : 2.0 * (std::fabs(d) + d_error));
    const bool sure = std::fabs(divisor) > error && std::fabs(divisor) > kSmallest && M < kLargest &&
                      L < kLargest && size * steepest_ < 0.5 * std::fabs(divisor) * kSteepest;
    return !sure ? 0 : divisor > 0.0 ? 1 : -1;
}

}  // namespace edgewise
