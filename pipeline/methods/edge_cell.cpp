#include "pipeline/methods/edge_cell.h"

#include <algorithm>
#include <cmath>

#include "pipeline/sample_pattern.h"
#include "sdf/closest_approach.h"

namespace edgewise {
namespace {

/// Of a pixel's radius. Hits lie up to an eighth of it before their surface, so two of one plane up to that
/// apart.
constexpr double kOnPlane = 0.25;
/// Normals within 10 degrees may be one surface's.
constexpr double kSmoothCosine = 0.985;
/// What a sample may be on the wrong side of a line, in pixels: of hits' own inexactness.
constexpr double kLineSlack = 1.0 / 16.0;

double radiusAt(const sdf::FieldRay& ray, double t) {
    return ray.pixel_radius + ray.pixel_slope * t;
}

double offPlane(const CellPiece& piece, const glm::dvec3& p) {
    return std::abs(glm::dot(p - piece.p_world, piece.n_world));
}

/// The labels seen, each once.
std::vector<int> labelsOf(const EdgeCell& cell) {
    std::vector<int> seen(cell.labels, cell.labels + cell.samples);
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    return seen;
}

/// Samples by depth, front to back.
std::vector<int> byDepth(const EdgeCell& cell) {
    std::vector<int> order(cell.samples);
    for (int i = 0; i < cell.samples; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](int a, int b) { return cell.depths[a] < cell.depths[b]; });
    return order;
}

}  // namespace

CellPiece pieceOf(const sdf::SurfaceHit* hit, const glm::dvec2& seen_px) {
    CellPiece piece;
    piece.seen_px = seen_px;
    piece.sky = hit == nullptr;
    if (!hit) return piece;
    piece.p_world = hit->p_world, piece.n_world = hit->normal_world, piece.material = hit->material;
    return piece;
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

int EdgeCells::labelOf(const EdgeCell& cell, int i, double depth) const {
    const sdf::FieldRay ray = rayOf(cell.sampleAt(i));
    const glm::dvec3 p =
        std::isfinite(depth) ? ray.origin_world + ray.direction_world * depth : glm::dvec3(0.0);
    int label = EdgeCell::kUnknown;
    double least = HUGE_VAL;
    for (int k = 0; k < static_cast<int>(cell.pieces.size()); ++k) {
        const CellPiece& piece = cell.pieces[k];
        if (piece.sky != !std::isfinite(depth)) continue;
        if (piece.sky) return k;
        const double off = offPlane(piece, p), apart = glm::distance(p, piece.p_world);
        if (off > kOnPlane * radiusAt(ray, depth) + 0.5 * piece.bend * apart * apart || off >= least)
            continue;
        least = off, label = k;
    }
    return label;
}

bool EdgeCells::divideByCrease(EdgeCell& cell, int a, int b) const {
    CellPiece &first = cell.pieces[a], &second = cell.pieces[b];
    if (first.sky || second.sky) return false;
    auto line = sdf::crease(grid_, first.p_world, first.n_world, second.p_world, second.n_world);
    if (!line) return false;
    if (line->at(first.seen_px) > line->at(second.seen_px)) line = line->reversed();
    for (int i = 0; i < cell.samples; ++i) {
        const double side = line->at(cell.sampleAt(i));
        if ((cell.labels[i] == a ? side : -side) > kLineSlack) return false;
    }
    first.weight = sdf::areaOf(sdf::squareWithin(cell.centre_px, {&*line, 1}));
    second.weight = 1.0 - first.weight;
    return true;
}

std::optional<sdf::FilmLine> EdgeCells::outlineFrom(const glm::dvec2& p_px, double t) const {
    const auto near = sdf::closestApproach(tracer_->cells(), rayOf(p_px), t);
    if (!near) return std::nullopt;
    return sdf::outline(grid_, near->surface_world, near->outwards_world);
}

/// What is in front ends in straight outlines: the samples that see past it find them, each the one on its
/// side, up to two.
bool EdgeCells::divideByOutline(EdgeCell& cell) const {
    const std::vector<int> order = byDepth(cell);
    // Where the depth leaps most is where the front ends.
    std::size_t split = 1;
    double leap = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i) {
        const double before = cell.depths[order[i - 1]], after = cell.depths[order[i]];
        const double ratio = std::isfinite(after) ? after / before : HUGE_VAL;
        if (cell.labels[order[i]] != cell.labels[order[i - 1]] && ratio > leap) leap = ratio, split = i;
    }
    std::vector<bool> front(cell.pieces.size());
    for (std::size_t i = 0; i < split; ++i) front[cell.labels[order[i]]] = true;
    for (std::size_t i = split; i < order.size(); ++i)
        if (front[cell.labels[order[i]]]) return false;
    std::vector<sdf::FilmLine> lines;
    const auto outside = [&](int i) {
        return std::ranges::any_of(lines, [&](const auto& line) { return line.at(cell.sampleAt(i)) > 0.0; });
    };
    for (std::size_t i = split; i < order.size(); ++i) {
        if (outside(order[i])) continue;
        if (lines.size() == 2) return false;
        // The front sample nearest to it says how deep the outline is.
        int nearest = order[0];
        for (std::size_t k = 0; k < split; ++k)
            if (glm::distance(cell.sampleAt(order[k]), cell.sampleAt(order[i])) <
                glm::distance(cell.sampleAt(nearest), cell.sampleAt(order[i])))
                nearest = order[k];
        const auto line = outlineFrom(cell.sampleAt(order[i]), cell.depths[nearest]);
        if (!line || line->at(cell.sampleAt(order[i])) <= 0.0) return false;
        lines.push_back(*line);
    }
    for (std::size_t i = 0; i < split; ++i)
        for (const sdf::FilmLine& line : lines)
            if (line.at(cell.sampleAt(order[i])) > kLineSlack) return false;
    const double share = sdf::areaOf(sdf::squareWithin(cell.centre_px, lines));
    // Within either side by count.
    int counts[2] = {0, 0};
    for (int i = 0; i < cell.samples; ++i) ++counts[front[cell.labels[i]]];
    for (int i = 0; i < cell.samples; ++i) {
        const bool is_front = front[cell.labels[i]];
        cell.pieces[cell.labels[i]].weight += (is_front ? share : 1.0 - share) / counts[is_front];
    }
    const bool one_each = labelsOf(cell).size() == 2;
    // Counts of few samples say little of what shares a side.
    if (!one_each && cell.samples < EdgeCell::kMost) {
        for (CellPiece& piece : cell.pieces) piece.weight = 0.0;
        return false;
    }
    return true;
}

/// All samples see past a solid that the cone met: a strip or a wedge of it, between the outlines on its two
/// sides.
bool EdgeCells::divideByStrip(EdgeCell& cell) const {
    const auto near = sdf::closestApproach(tracer_->cells(), rayOf(cell.centre_px), *cell.soft_t);
    if (!near) return false;
    const auto line = sdf::outline(grid_, near->surface_world, near->outwards_world);
    if (!line || line->at(cell.centre_px) <= 0.0) return false;
    std::vector<sdf::FilmLine> lines{*line};
    // A pixel beyond the outline: past a thin part, or on a wide one.
    const glm::dvec2 beyond =
        cell.centre_px - (line->at(cell.centre_px) + 1.0) * glm::dvec2(line->a, line->b);
    if (const auto other = outlineFrom(beyond, near->t))
        if (other->a * line->a + other->b * line->b < 0.0 && other->at(beyond) > 0.0) lines.push_back(*other);
    for (int i = 0; i < cell.samples; ++i)
        if (std::ranges::all_of(lines, [&](const auto& l) { return l.at(cell.sampleAt(i)) < -kLineSlack; }))
            return false;
    const std::vector<glm::dvec2> part = sdf::squareWithin(cell.centre_px, lines);
    const double share = part.empty() ? 0.0 : sdf::areaOf(part);
    for (int i = 0; i < cell.samples; ++i) cell.pieces[cell.labels[i]].weight += (1.0 - share) / cell.samples;
    if (share == 0.0) return true;
    const glm::dvec2 place = sdf::centroidOf(part);
    const sdf::FieldRay ray = rayOf(place);
    const double t = glm::dot(near->surface_world - ray.origin_world, ray.direction_world);
    const sdf::SurfaceHit hit = tracer_->fieldHit(ray, {sdf::TraceEnd::kSurface, t, NAN, 0, 0, 0}, cell.sign);
    CellPiece piece = pieceOf(&hit, place);
    piece.hit = hit, piece.weight = share;
    cell.pieces.push_back(piece);
    return true;
}

void EdgeCells::divideByLines(EdgeCell& cell) const {
    const std::vector<int> seen = labelsOf(cell);
    if (seen.size() == 1 && !cell.soft_t) {
        cell.pieces[seen[0]].weight = 1.0;
        cell.resolved = true;
    } else if (seen.size() == 1) {
        cell.resolved = tracer_ && divideByStrip(cell);
    } else {
        cell.resolved = (seen.size() == 2 && divideByCrease(cell, seen[0], seen[1])) ||
                        (tracer_ && divideByOutline(cell));
    }
}

void EdgeCell::divideByCount() {
    for (int i = 1 + kCorners; i < kMost; ++i) pieces[labels[i]].weight += 1.0 / kStandard;
    resolved = true;
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

}  // namespace edgewise
