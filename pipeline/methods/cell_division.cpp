#include "pipeline/methods/cell_division.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdf/closest_approach.h"

namespace edgewise {
namespace {

/// What a sample may be on the wrong side of a line, in pixels: of hits' own inexactness.
constexpr double kLineSlack = 1.0 / 16.0;
/// Outlines asked for before samples are counted.
constexpr int kMostOutlines = 3;

double radiusAt(const sdf::FieldRay& ray, double t) {
    return ray.pixel_radius + ray.pixel_slope * t;
}

using Polygon = std::vector<glm::dvec2>;

/// Some of a cell's samples, in the order of their numbers.
struct SampleSet {
    std::array<std::int8_t, EdgeCell::kMost> at{};
    int count = 0;
    void add(int i) { at[static_cast<std::size_t>(count++)] = static_cast<std::int8_t>(i); }
    const std::int8_t* begin() const { return at.data(); }
    const std::int8_t* end() const { return at.data() + count; }
};

/// The labels seen, each once.
std::vector<int> labelsOf(const EdgeCell& cell, const SampleSet& samples) {
    std::vector<int> seen;
    for (const int i : samples)
        if (std::ranges::find(seen, cell.labels[i]) == seen.end()) seen.push_back(cell.labels[i]);
    return seen;
}

/// Whether each of two planes lies below the other, where it was met.
bool edgeSticksOut(const CellPiece& a, const CellPiece& b, double sign) {
    const glm::dvec3 apart = b.p_world - a.p_world;
    return sign * glm::dot(apart, a.n_world) < 0.0 && sign * glm::dot(apart, b.n_world) > 0.0;
}

}  // namespace

/// One cell's division.
class CellDivision::Work {
  public:
    Work(const CellDivision& dividing, EdgeCell& cell, bool may_count)
        : dividing_(dividing), cell_(cell), may_count_(may_count) {}

    bool part(const Polygon& polygon, const SampleSet& samples) {
        const std::vector<int> seen = labelsOf(cell_, samples);
        if (seen.size() == 1) {
            cell_.add({seen[0], 1.0, polygon});
            return true;
        }
        // What ends in front of another ends in an outline; two alone may also meet.
        bool fits = false;
        if (seen.size() == 2 && byCreases(polygon, samples, seen, fits)) return true;
        if (!fits && byOutline(polygon, samples, fits)) return true;
        if (!fits && seen.size() > 2 && byCreases(polygon, samples, seen, fits)) return true;
        return !fits && may_count_ && byCount(polygon, samples);
    }

  private:
    /// Which side a sample is on, -1 for the inner one; 0: as the line says.
    template <class Side>
    bool halve(const Polygon& polygon, const SampleSet& samples, const sdf::FilmLine& line, const Side& side,
               bool& fits) {
        SampleSet inner, outer;
        for (const int i : samples) {
            const double at = line.at(cell_.sampleAt(i));
            const int wanted = side(i);
            if (wanted != 0 && wanted * at < -kLineSlack) return false;
            ((wanted != 0 ? wanted < 0 : at <= 0.0) ? inner : outer).add(i);
        }
        if (inner.count == 0 || outer.count == 0) return false;
        fits = true;
        return part(sdf::within(polygon, line), inner) && part(sdf::within(polygon, line.reversed()), outer);
    }

    bool byCreases(const Polygon& polygon, const SampleSet& samples, const std::vector<int>& seen,
                   bool& fits) {
        for (std::size_t a = 0; a < seen.size() && !fits; ++a)
            for (std::size_t b = a + 1; b < seen.size() && !fits; ++b)
                if (byCrease(polygon, samples, seen[a], seen[b], fits)) return true;
        return false;
    }

    bool byCrease(const Polygon& polygon, const SampleSet& samples, int a, int b, bool& fits) {
        const CellPiece &first = cell_.pieces[a], &second = cell_.pieces[b];
        if (first.sky || second.sky) return false;
        auto line =
            sdf::crease(dividing_.grid_, first.p_world, first.n_world, second.p_world, second.n_world);
        if (!line) return false;
        if (line->at(first.seen_px) > line->at(second.seen_px)) line = line->reversed();
        return halve(
            polygon, samples, *line,
            [&](int i) { return cell_.labels[i] == a   ? -1
                                : cell_.labels[i] == b ? 1
                                                       : 0; }, fits);
    }

    /// The deepest samples see past what is nearest beside them.
    bool byOutline(const Polygon& polygon, const SampleSet& samples, bool& fits) {
        if (!dividing_.tracer_) return false;
        std::vector<int> order(samples.begin(), samples.end());
        std::ranges::stable_sort(order, [&](int i, int k) { return cell_.depths[i] > cell_.depths[k]; });
        int asked = 0;
        for (const int i : order) {
            const int front = beside(samples, i);
            if (front == EdgeCell::kUnknown) continue;
            if (asked++ == kMostOutlines) break;
            const auto line = dividing_.outlineFrom(cell_.sampleAt(i), cell_.depths[front]);
            if (!line || line->at(cell_.sampleAt(i)) <= 0.0) continue;
            const auto side = [&](int k) {
                return k == i ? 1 : cell_.labels[k] == cell_.labels[front] ? -1 : 0;
            };
            if (halve(polygon, samples, *line, side, fits)) return true;
            if (fits) return false;
        }
        return false;
    }

    /// The sample nearest to that one on the film that sees another piece, before it.
    int beside(const SampleSet& samples, int i) const {
        int nearest = EdgeCell::kUnknown;
        const auto apart = [&](int k) { return glm::distance(cell_.sampleAt(k), cell_.sampleAt(i)); };
        for (const int k : samples)
            if (cell_.labels[k] != cell_.labels[i] && cell_.depths[k] < cell_.depths[i] &&
                (nearest == EdgeCell::kUnknown || apart(k) < apart(nearest)))
                nearest = k;
        return nearest;
    }

    /// The standard samples, if there are any: corners tell of four pixels.
    bool byCount(const Polygon& polygon, const SampleSet& samples) {
        const auto tells = [](int i) { return i > EdgeCell::kCorners; };
        const bool standard = std::ranges::any_of(samples, tells);
        std::vector<int> counts(cell_.pieces.size());
        int all = 0;
        for (const int i : samples)
            if (!standard || tells(i)) ++counts[static_cast<std::size_t>(cell_.labels[i])], ++all;
        for (std::size_t piece = 0; piece < counts.size(); ++piece)
            if (counts[piece] > 0)
                cell_.add({static_cast<int>(piece), static_cast<double>(counts[piece]) / all, polygon});
        return cell_.counted = true;
    }

    const CellDivision& dividing_;
    EdgeCell& cell_;
    const bool may_count_;
};

int CellDivision::labelOf(const EdgeCell& cell, int i, double depth) const {
    const sdf::FieldRay ray = rayOf(cell.sampleAt(i));
    const glm::dvec3 p =
        std::isfinite(depth) ? ray.origin_world + ray.direction_world * depth : glm::dvec3(0.0);
    const double slack = kOnPlane * radiusAt(ray, depth);
    int label = EdgeCell::kUnknown;
    double height = 0.0;
    for (int k = 0; k < static_cast<int>(cell.pieces.size()); ++k) {
        const CellPiece& piece = cell.pieces[k];
        if (piece.sky != !std::isfinite(depth)) continue;
        if (piece.sky) return k;
        const double above = cell.sign * glm::dot(p - piece.p_world, piece.n_world);
        const double apart = glm::distance(p, piece.p_world);
        if (std::abs(above) > slack + 0.5 * piece.bend * apart * apart) continue;
        // Where two planes meet in an edge that sticks out, the surface is the lower one of the two: the
        // point is higher above its own.
        const bool higher =
            label != EdgeCell::kUnknown && edgeSticksOut(cell.pieces[label], piece, cell.sign);
        if (label != EdgeCell::kUnknown && (higher ? above <= height : std::abs(above) >= std::abs(height)))
            continue;
        height = above, label = k;
    }
    if (label != EdgeCell::kUnknown) return label;
    // A ray that begins within a solid meets no surface where it is said to: what was asked of it is its own.
    const auto own = std::ranges::find(cell.pieces, cell.sampleAt(i),
                                       [](const CellPiece& piece) { return piece.seen_px; });
    return own == cell.pieces.end() ? EdgeCell::kUnknown : static_cast<int>(own - cell.pieces.begin());
}

std::optional<sdf::FilmLine> CellDivision::outlineFrom(const glm::dvec2& p_px, double t) const {
    const auto near = sdf::closestApproach(tracer_->cells(), rayOf(p_px), t);
    if (!near) return std::nullopt;
    return sdf::outline(grid_, near->surface_world, near->outwards_world);
}

/// All samples see past a solid that the cone met: a strip or a wedge of it, between the outlines on its two
/// sides.
bool CellDivision::divideByStrip(EdgeCell& cell) const {
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
    const int past = cell.labels[0];
    Polygon part = sdf::squareWithin(cell.centre_px, {});
    for (const sdf::FilmLine& l : lines) {
        cell.add({past, 1.0, sdf::within(part, l.reversed())});
        part = sdf::within(part, l);
    }
    if (sdf::areaOf(part) == 0.0) return true;
    const glm::dvec2 place = sdf::centroidOf(part);
    const sdf::FieldRay ray = rayOf(place);
    const double t = glm::dot(near->surface_world - ray.origin_world, ray.direction_world);
    const sdf::SurfaceHit hit = tracer_->fieldHit(ray, {sdf::TraceEnd::kSurface, t, NAN, 0, 0, 0}, cell.sign);
    CellPiece piece = pieceOf(planeOf(&hit), place);
    piece.hit = hit;
    cell.pieces.push_back(piece);
    cell.add({static_cast<int>(cell.pieces.size()) - 1, 1.0, std::move(part)});
    return true;
}

void CellDivision::divide(EdgeCell& cell, bool may_count) const {
    SampleSet all;
    for (int i = 0; i < cell.samples; ++i) all.add(i);
    const bool strip = cell.soft_t && tracer_ && labelsOf(cell, all).size() == 1;
    if (strip && divideByStrip(cell)) {
        cell.resolved = true;
        return;
    }
    if (strip && !may_count) return;
    cell.counted = strip;
    cell.resolved = Work(*this, cell, may_count).part(sdf::squareWithin(cell.centre_px, {}), all);
    if (cell.resolved) return;
    cell.parts.clear();
    for (CellPiece& piece : cell.pieces) piece.weight = 0.0;
}

}  // namespace edgewise
