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

CellPiece pieceOf(const sdf::SurfaceHit* hit, const glm::dvec2& seen_px) {
    CellPiece piece;
    piece.seen_px = seen_px;
    piece.sky = hit == nullptr;
    if (!hit) return piece;
    piece.p_world = hit->p_world - hit->normal_world * hit->height;
    piece.n_world = hit->normal_world, piece.material = hit->material;
    return piece;
}

double offPlane(const CellPiece& piece, const glm::dvec3& p) {
    return std::abs(glm::dot(p - piece.p_world, piece.n_world));
}

bool smoothlyOne(const CellPiece& a, const CellPiece& b, double radius) {
    if (a.sky || b.sky) return a.sky == b.sky;
    if (a.material != b.material || glm::dot(a.n_world, b.n_world) < kSmoothCosine) return false;
    // An arc leaves its tangent by half of what its normal turns by, times its length.
    const double arc = 0.5 * glm::distance(a.n_world, b.n_world) * glm::distance(a.p_world, b.p_world);
    return std::max(offPlane(a, b.p_world), offPlane(b, a.p_world)) <= kOnPlane * radius + arc;
}

void takeBend(CellPiece& piece, const CellPiece& other) {
    const double apart = glm::distance(piece.p_world, other.p_world);
    if (!piece.sky && !other.sky && apart > 0.0)
        piece.bend = std::max(piece.bend, glm::distance(piece.n_world, other.n_world) / apart);
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
