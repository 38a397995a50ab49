#include "pipeline/methods/edge_cell.h"

#include <algorithm>
#include <cmath>

#include "pipeline/sample_pattern.h"
#include "sdf/film_line.h"

namespace edgewise {
namespace {

/// Normals within 10 degrees may be one surface's.
constexpr double kSmoothCosine = 0.985;

}  // namespace

SurfacePlane planeOf(const sdf::SurfaceHit* hit) {
    if (!hit) return {};
    return {false, hit->p_world - hit->normal_world * hit->height, hit->normal_world, hit->material};
}

CellPiece pieceOf(const SurfacePlane& plane, const glm::dvec2& seen_px) {
    CellPiece piece;
    static_cast<SurfacePlane&>(piece) = plane;
    piece.seen_px = seen_px;
    return piece;
}

double offPlane(const SurfacePlane& plane, const glm::dvec3& p) {
    return std::abs(glm::dot(p - plane.p_world, plane.n_world));
}

bool smoothlyOne(const SurfacePlane& a, const SurfacePlane& b, double radius) {
    if (a.sky || b.sky) return a.sky == b.sky;
    if (a.material != b.material || glm::dot(a.n_world, b.n_world) < kSmoothCosine) return false;
    const double off = std::max(offPlane(a, b.p_world), offPlane(b, a.p_world));
    if (off <= kOnPlane * radius) return true;
    // An arc leaves its tangent by half of what its normal turns by, times its length.
    const double arc = 0.5 * glm::distance(a.n_world, b.n_world) * glm::distance(a.p_world, b.p_world);
    return off <= kOnPlane * radius + arc;
}

double bendBetween(const SurfacePlane& a, const SurfacePlane& b) {
    const double apart = glm::distance(a.p_world, b.p_world);
    return !a.sky && !b.sky && apart > 0.0 ? glm::distance(a.n_world, b.n_world) / apart : 0.0;
}

glm::dvec2 EdgeCell::sampleAt(int i) const {
    if (i == 0) return centre_px;
    if (i <= kCorners) return centre_px + glm::dvec2(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5);
    return countedPlace(centre_px, i - 1 - kCorners);
}

glm::dvec2 countedPlace(const glm::dvec2& centre_px, int i) {
    static const SamplePattern pattern = standardPattern(EdgeCell::kStandard);
    return centre_px + pattern.at_px[static_cast<std::size_t>(i)] - 0.5 + 1.0 / 32.0;
}

int EdgeCell::sampleOf(int piece) const {
    glm::dvec2 sum(0.0);
    int count = 0;
    for (int i = 0; i < samples; ++i)
        if (labels[i] == piece) sum += sampleAt(i), ++count;
    int best = kUnknown;
    for (int i = 0; i < samples; ++i) {
        if (labels[i] != piece) continue;
        const auto off = [&](int k) { return glm::distance(sampleAt(k), sum / static_cast<double>(count)); };
        if (best == kUnknown || off(i) < off(best)) best = i;
    }
    return best;
}

void EdgeCell::add(CellPart part) {
    pieces[static_cast<std::size_t>(part.piece)].weight += part.share * sdf::areaOf(part.polygon_px);
    parts.push_back(std::move(part));
}

}  // namespace edgewise
