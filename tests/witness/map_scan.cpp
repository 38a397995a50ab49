#include "tests/witness/map_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "tests/witness/dice.h"
#include "tests/witness/events.h"
#include "tests/witness/scanline.h"
#include "tests/witness/scanline_quadrature.h"

namespace edgewise::witness {
namespace {

Real local(double grid, double rest, double sample) {
    return Real(Quad(grid) - sample + rest);
}

/// How many times each owner is in front, counted from the labels alone: one owner once, all others never.
class Front {
  public:
    explicit Front(Owner first) { count_[first] = 1; }
    void pass(const MapCrossing& crossing) {
        change(crossing.left, -1);
        change(crossing.right, 1);
    }
    bool single() const { return count_.size() == 1 && count_.begin()->second == 1; }
    Owner owner() const { return count_.begin()->first; }

  private:
    std::map<Owner, int> count_;
    void change(Owner owner, int by) {
        if ((count_[owner] += by) == 0) count_.erase(owner);
    }
};

/// Both sides compute u = u_0 + slope v with about eight roundings of terms up to (1 + |slope|) reach.
Real roundingOf(Real reach, Real slope) {
    return 8 * reach * (1 + std::fabs(slope)) * 0x1p-64L;
}

/// The owner at -radius. Crossings closer than the map may move a line (to a vertex that it passes nearer
/// than 2^-40 px) may stand in any order: of a cluster's labels the owner before it is the one that is left
/// more often than entered, the owner behind it the one that is entered more often than left; a cluster that
/// changes nothing leaves the question to the next. The first cluster within the radius is asked first, since
/// nothing beyond is judged; where there is none, the last one before it; else the first one behind it.
Owner ownerAtStart(const std::vector<MapCrossing>& crossings, Real radius, Owner otherwise) {
    constexpr Real kCluster = 0x1p-39L;
    std::optional<Owner> reached;
    for (std::size_t k = 0; k < crossings.size();) {
        const bool beyond = crossings[k].u <= -radius;
        if (reached && crossings[k].u >= radius) return *reached;
        std::map<Owner, int> net;
        Real end = crossings[k].u;
        for (; k < crossings.size() && crossings[k].u <= end && (crossings[k].u <= -radius) == beyond; ++k) {
            --net[crossings[k].left], ++net[crossings[k].right];
            end = std::max(end, crossings[k].u + kCluster * (1 + std::fabs(crossings[k].slope)));
        }
        const int asked = beyond ? 1 : -1;
        for (const auto& [owner, count] : net) {
            if (count * asked <= 0) continue;
            if (!beyond) return owner;
            reached = owner;
        }
    }
    return reached.value_or(otherwise);
}

Owner runOwner(const std::vector<Run>& runs, Real u) {
    for (const Run& run : runs)
        if (u < run.u_hi) return run.owner;
    return runs.back().owner;
}

}  // namespace

void ScanVerdict::add(const ScanVerdict& other) {
    scanlines += other.scanlines;
    crossings += other.crossings;
    broken += other.broken;
    disagreements += other.disagreements;
    widest_px = std::max(widest_px, other.widest_px);
    wrong_px2 += other.wrong_px2;
    worst_offset_px = std::max(worst_offset_px, other.worst_offset_px);
    if (first.empty()) first = other.first;
}

MapScan::MapScan(const VisibleMap& map, glm::dvec2 sample_px, Axes axes)
    : exchanged_(axes == Axes::kExchanged) {
    for (const VisibleSegment& s : map.segments) {
        Real au = local(s.a.grid.x, s.a.rest.x, sample_px.x), av = local(s.a.grid.y, s.a.rest.y, sample_px.y);
        Real bu = local(s.b.grid.x, s.b.rest.x, sample_px.x), bv = local(s.b.grid.y, s.b.rest.y, sample_px.y);
        Owner left = s.left, right = s.right;
        if (exchanged_) std::swap(au, av), std::swap(bu, bv), std::swap(left, right);
        if (av > bv) std::swap(au, bu), std::swap(av, bv), std::swap(left, right);
        if (av < bv) walls_.push_back({au, av, bu, bv, left, right});
    }
}

std::vector<MapCrossing> MapScan::cross(Real v) const {
    std::vector<MapCrossing> crossings;
    for (const Wall& w : walls_) {
        if (v < w.v_lo || v >= w.v_hi) continue;
        const Real slope = (w.u_hi - w.u_lo) / (w.v_hi - w.v_lo);
        const bool lower_end = v - w.v_lo < w.v_hi - v;  // from the nearer end: less rounding
        const Real u = lower_end ? w.u_lo + slope * (v - w.v_lo) : w.u_hi - slope * (w.v_hi - v);
        crossings.push_back({u, slope, w.left, w.right});
    }
    std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) { return a.u < b.u; });
    return crossings;
}

void MapScan::compare(const LocalScene& scene, Real v, Real height, Real radius, ScanVerdict& verdict) const {
    const std::vector<MapCrossing> crossings = cross(v);
    const std::vector<Run> runs = Scanline(scene).cut(v, radius);
    ++verdict.scanlines;
    verdict.crossings += crossings.size();
    if (crossings.empty() && runs.size() == 1) return;  // who it is, the map's rows say
    std::vector<Real> cuts = {-radius, radius};
    for (const Run& run : runs) cuts.push_back(run.u_lo);
    for (const MapCrossing& c : crossings)
        if (std::fabs(c.u) < radius) cuts.push_back(c.u);
    std::sort(cuts.begin(), cuts.end());
    Front front(ownerAtStart(crossings, radius, runs.front().owner));
    std::size_t next = 0;
    while (next < crossings.size() && crossings[next].u <= -radius) ++next;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const Real length = cuts[k + 1] - cuts[k], middle = (cuts[k] + cuts[k + 1]) / 2;
        if (length <= 0) continue;
        for (; next < crossings.size() && crossings[next].u <= cuts[k]; ++next) front.pass(crossings[next]);
        const Owner truth = runOwner(runs, middle);
        if (front.single() && front.owner() == truth) continue;
        const Real before = next > 0 ? std::fabs(crossings[next - 1].slope) : 0;
        const Real after = next < crossings.size() ? std::fabs(crossings[next].slope) : 0;
        const Real steepest = 1 + std::max(before, after);
        const Real rounding = roundingOf(radius, steepest - 1);
        verdict.worst_offset_px = std::max(verdict.worst_offset_px, length / steepest);
        if (length <= rounding) continue;
        (front.single() ? verdict.disagreements : verdict.broken) += 1;
        verdict.widest_px = std::max(verdict.widest_px, length);
        verdict.wrong_px2 += length * height;
        if (verdict.first.empty())
            verdict.first = fmt::format(
                "along {}: v = {:.20g} (band {:.2g} px), u in [{:.20g}, {:.20g}], length {:.3g}: owner {} in "
                "truth, {} on the map",
                exchanged_ ? "y" : "x", double(v), double(height), double(cuts[k]), double(cuts[k + 1]),
                double(length), truth, front.single() ? fmt::format("{}", front.owner()) : "no single one");
    }
}

ScanVerdict compareMap(const ScreenScene& scene, const VisibleMap& map, glm::dvec2 sample_px, Real radius,
                       std::uint64_t seed, int random_lines) {
    Dice dice(seed);
    Kernel square;
    square.radius = radius;
    ScanVerdict verdict;
    for (Axes axes : {Axes::kAsTheyAre, Axes::kExchanged}) {
        const bool exchanged = axes == Axes::kExchanged;
        const LocalScene truth = exchanged ? LocalScene(swapAxes(scene), {sample_px.y, sample_px.x}, radius)
                                           : LocalScene(scene, sample_px, radius);
        const MapScan scan(map, sample_px, axes);
        const std::vector<Real> events = eventOrdinates(truth, square);
        for (std::size_t k = 0; k + 1 < events.size(); ++k)
            if (events[k + 1] - events[k] > 0x1p-50L)  // two names of one event
                scan.compare(truth, (events[k] + events[k + 1]) / 2, events[k + 1] - events[k], radius,
                             verdict);
        for (int k = 0; k < random_lines; ++k)
            scan.compare(truth, dice.uniform(-double(radius), double(radius)), 2 * radius / random_lines,
                         radius, verdict);
    }
    return verdict;
}

}  // namespace edgewise::witness
