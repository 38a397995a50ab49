#include "pipeline/shading_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "analytic/fine_point.h"

namespace edgewise {
namespace {

/// Below it a centroid, a moment good to a few 2^-53 R over the weight, could err by 2^-19 R.
constexpr FixedWeight kLeastWeight = FixedWeight{1} << (kWeightBits - 32);

FixedWeight toFixed(double x) {
    return static_cast<FixedWeight>(std::nearbyint(x * 0x1p60));
}

using Lanes = std::array<std::int64_t, OwnerTable::kLanes>;

/// On the way sums may leave the range: they come back, modulo 2^64.
void addLanes(Lanes& sum, const Lanes& terms, std::int64_t sign) {
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] = static_cast<std::int64_t>(static_cast<std::uint64_t>(sum[i]) +
                                           static_cast<std::uint64_t>(sign * terms[i]));
}

glm::dvec2 toGrid(glm::dvec2 offset_px) {
    return {std::nearbyint(offset_px.x * 0x1p32) * 0x1p-32, std::nearbyint(offset_px.y * 0x1p32) * 0x1p-32};
}

/// The digits of i in the base, mirrored at the point.
double radicalInverse(int i, int base) {
    double value = 0.0, digit = 1.0 / base;
    for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
    return value;
}

std::vector<glm::dvec2> haltonPoints(const Prefilter& filter, int tries) {
    std::vector<glm::dvec2> points;
    for (int i = 1; i <= tries; ++i) {
        const glm::dvec2 p = glm::dvec2(radicalInverse(i, 2), radicalInverse(i, 3)) * 2.0 - 1.0;
        if (!filter.radial() || p.x * p.x + p.y * p.y < 1.0) points.push_back(toGrid(p * filter.radius));
    }
    return points;
}

}  // namespace

ShadingPointFinder::ShadingPointFinder(const Prefilter& filter, const ShadingChoice& choice)
    : centroid_(choice.mode == ShadingMode::kCentroid),
      samples_(choice.mode == ShadingMode::kSamples ? choice.samples : 0),
      radius_(filter.radius),
      moments_(centroidMeasure(filter)) {
    if (!active()) return;
    const Prefilter measure = centroidMeasure(filter);
    if (measure.name != filter.name) area_ = std::make_unique<PixelWeights>(measure);
    candidates_ = haltonPoints(filter, samples_ * kTriesPerPoint);
}

void ShadingPointFinder::begin(glm::dvec2 first_sample_px, int count) {
    first_ = first_sample_px;
    count_ = count;
    moment_x_.clear();
    moment_y_.clear();
    edges_.clear();
    if (area_) area_->begin(first_sample_px, count);
}

void ShadingPointFinder::add(const VisibleSegment& segment, const CarrierLine& line, Owner left,
                             Owner right) {
    if (left == right) return;
    if (area_) area_->add(segment, line, left, right);
    if (samples_ > 0) addEdge(segment, left, right);
    Lanes x{}, y{};
    FixedWeight any = 0;
    for (int i = 0; i < count_; ++i) {
        const glm::dvec2 m = moments_.moment(segment, line, first_ + glm::dvec2(i, 0));
        x[i] = toFixed(m.x), y[i] = toFixed(m.y);
        any |= x[i] | y[i];
    }
    if (any == 0) return;
    addLanes(moment_x_.row(left).weight, x, 1), addLanes(moment_x_.row(right).weight, x, -1);
    addLanes(moment_y_.row(left).weight, y, 1), addLanes(moment_y_.row(right).weight, y, -1);
}

/// Segments lead towards +y, or -x: their left owner has the smaller x, so where they also lead towards +x it
/// lies below.
void ShadingPointFinder::addEdge(const VisibleSegment& segment, Owner left, Owner right) {
    const glm::dvec2 a = (segment.a.grid - first_) + segment.a.rest,
                     b = (segment.b.grid - first_) + segment.b.rest;
    if (a.x < b.x) edges_.push_back({a, b, right, left});
    if (a.x > b.x) edges_.push_back({b, a, left, right});
}

void ShadingPointFinder::measure(const Owner* base_owner) {
    area_entries_.clear();
    if (area_) area_->finish(base_owner, area_entries_, area_offset_);
}

FixedWeight ShadingPointFinder::measured(const OwnerWeight& entry, int lane) const {
    if (!area_) return entry.weight;
    const auto begin = area_entries_.begin() + static_cast<std::ptrdiff_t>(area_offset_[lane]),
               end = area_entries_.begin() + static_cast<std::ptrdiff_t>(area_offset_[lane + 1]);
    const auto found = std::lower_bound(begin, end, entry.owner,
                                        [](const OwnerWeight& e, Owner owner) { return e.owner < owner; });
    return found == end || found->owner != entry.owner ? 0 : found->weight;
}

std::optional<glm::dvec2> ShadingPointFinder::centroid(const OwnerWeight& entry, int lane) {
    const FixedWeight weight = measured(entry, lane);
    if (weight < kLeastWeight) return std::nullopt;
    const glm::dvec2 moment(static_cast<double>(moment_x_.row(entry.owner).weight[lane]),
                            static_cast<double>(moment_y_.row(entry.owner).weight[lane]));
    return toGrid(moment / static_cast<double>(weight) * radius_);
}

/// From the samples' row, where owners are known, straight up or down to the point: what lies beyond the last
/// edge on the way has it. Between edges through one place of the way the steeper one is the last for a point
/// just right of it; the row's owner lies right of an edge through the row's own point, and below a
/// horizontal one.
Owner ShadingPointFinder::ownerAt(glm::dvec2 q, const RowOwner& row) const {
    const double way = q.y < 0.0 ? -1.0 : 1.0;
    const Edge* last = nullptr;
    double last_y = 0.0, last_slope = 0.0;
    for (const Edge& edge : edges_) {
        if (q.x < edge.a.x || q.x >= edge.b.x) continue;
        const double slope = way * (edge.b.y - edge.a.y) / (edge.b.x - edge.a.x);
        const double y = way * edge.a.y + slope * (q.x - edge.a.x);
        const bool leaves_row = y > 0.0 || (y == 0.0 && (slope > 0.0 || (slope == 0.0 && way < 0.0)));
        if (!leaves_row || y > way * q.y) continue;
        if (last && (y < last_y || (y == last_y && slope <= last_slope))) continue;
        last = &edge, last_y = y, last_slope = slope;
    }
    if (!last) return row(first_.x + q.x);
    return way > 0.0 ? last->below : last->above;
}

void ShadingPointFinder::collectSamples(int lane, const RowOwner& row, std::span<const OwnerWeight> entries) {
    const auto wanted = static_cast<std::size_t>(samples_);
    std::size_t open = entries.size();
    for (const glm::dvec2& offset : candidates_) {
        if (open == 0) return;
        const Owner owner = ownerAt(offset + glm::dvec2(lane, 0), row);
        const auto at = std::lower_bound(entries.begin(), entries.end(), owner,
                                         [](const OwnerWeight& e, Owner o) { return e.owner < o; });
        if (at == entries.end() || at->owner != owner) continue;
        std::vector<glm::dvec2>& found = found_[static_cast<std::size_t>(at - entries.begin())];
        if (found.size() == wanted) continue;
        found.push_back(offset);
        open -= found.size() == wanted;
    }
}

void ShadingPointFinder::finish(const Owner* base_owner, const RowOwner& row,
                                const std::vector<OwnerWeight>& entries, const std::size_t* offset,
                                ShadingPoints& out) {
    measure(base_owner);
    for (int lane = 0; lane < count_; ++lane) {
        const auto mine = std::span(entries).subspan(offset[lane], offset[lane + 1] - offset[lane]);
        if (found_.size() < mine.size()) found_.resize(mine.size());
        for (std::size_t e = 0; e < mine.size(); ++e) found_[e].clear();
        if (samples_ > 0) collectSamples(lane, row, mine);
        for (std::size_t e = 0; e < mine.size(); ++e) {
            if (found_[e].empty())
                if (const auto point = centroid(mine[e], lane)) found_[e].push_back(*point);
            out.offset_px.insert(out.offset_px.end(), found_[e].begin(), found_[e].end());
            out.end.push_back(out.offset_px.size());
        }
    }
}

void ShadingPointFinder::whole(ShadingPoints& out) const {
    const auto count = std::min(candidates_.size(), static_cast<std::size_t>(samples_));
    if (centroid_) out.offset_px.emplace_back(0.0);
    out.offset_px.insert(out.offset_px.end(), candidates_.begin(),
                         candidates_.begin() + static_cast<std::ptrdiff_t>(count));
    out.end.push_back(out.offset_px.size());
}

}  // namespace edgewise
