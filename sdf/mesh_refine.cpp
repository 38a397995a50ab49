#include "sdf/mesh_refine.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "sdf/evaluate.h"
#include "sdf/mesh_edit.h"
#include "sdf/mesh_feature.h"
#include "sdf/surface_distance.h"
#include "sdf/triangle_tree.h"

namespace edgewise::sdf {
namespace {

constexpr int kRounds = 10;
/// A change is worth it when what is off becomes less than this part.
constexpr double kGain = 0.8;
/// Of an edge's length: from its middle to where it is divided.
constexpr double kFarthest = 1.0;
/// Of a cell's side: a sharp edge or corner may be so far from where it is looked for.
constexpr double kReach = 4.0;
/// Of a cell's side: triangles that turned edges make are no narrower.
constexpr double kLeastHeight = 1e-3;

/// Of the way from an edge's middle to its ends: where normals are compared.
constexpr double kByEnd = 0.8, kEnd = 0.97;
/// Between sharp and round: of its share by length, a part turns no more than that and a little, which is
/// about the angle that mesh_feature tells apart.
constexpr double kEven = 1.5, kSlight = 0.03;
/// Of a cell's side: a vertex counts as on the surface.
constexpr double kOff = 1e-6;
/// Of the limit by sharp edges: vertices further off, which mending has left there, are asked to go back.
constexpr double kMended = 0.25;
/// The sine of half a wedge's angle: narrower ones count as of that.
constexpr double kNarrowest = 0.02;
/// Of a cell's side: edges that are longer were drawn so, to a sharp edge, and its limit is theirs.
constexpr double kLong = 2.0;
/// Of a cell's side: shorter edges are left alone.
constexpr double kShortest = 0.05;

/// Cosine between triangles' normals by a sharp edge.
constexpr double kFolded = 0.95;
/// Of the way from its middle to a tip: where its sides are asked for; of the limit: they meet there.
constexpr double kNear = 0.1, kByTip = 0.6, kOn = 1e-2;

/// Edges off in a brick: more than a sharp edge or two through its cells have.
constexpr std::uint32_t kMostInBrick = 16 * kBrickCells;

constexpr int kMostShifts = 4, kMostStuck = 4;
constexpr std::size_t kShiftPlanes = 16, kMostWays = 4;

/// Of triangles' longest sides; 1 where there are none.
double meanSize(const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const auto &a = mesh.position_world[t[0]], &b = mesh.position_world[t[1]],
                   &c = mesh.position_world[t[2]];
        sum += std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    }
    return sum > 0.0 ? sum / static_cast<double>(mesh.triangles.size()) : 1.0;
}

struct Candidate {
    std::uint32_t a, b;
    double off;
};

class Refiner {
  public:
    Refiner(SurfaceMesh& mesh, const TapeAt& tape, double step, const SharpCells& sharp,
            const MeshLimits& limits)
        : edit_(mesh, meanSize(mesh)), tape_(tape), step_(step), sharp_(sharp), limits_(limits) {}

    std::size_t run(std::vector<glm::dvec3>* left) {
        for (std::uint32_t v = 0; v < edit_.mesh().position_world.size(); ++v) shiftBack(v);
        std::vector<std::uint32_t> active(edit_.mesh().triangles.size());
        for (std::uint32_t t = 0; t < active.size(); ++t) active[t] = t;
        std::size_t budget = edit_.mesh().position_world.size();
        for (int round = 0; round < kRounds && !active.empty(); ++round) {
            touched_.clear();
            std::vector<Candidate> candidates = candidatesOf(active, round == 0);
            if (round == 0 && left) leaveToSmallerCells(candidates, *left);
            if (candidates.size() > budget) break;  // cells are too large for this surface
            budget -= candidates.size();
            for (const Candidate& c : candidates) improve(c);
            std::sort(touched_.begin(), touched_.end());
            touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
            for (const std::uint32_t v : std::vector(touched_)) shiftBack(v);
            active.clear();
            for (const std::uint32_t v : touched_)
                active.insert(active.end(), edit_.around(v).begin(), edit_.around(v).end());
            std::sort(active.begin(), active.end());
            active.erase(std::unique(active.begin(), active.end()), active.end());
        }
        edit_.compact();
        return added_;
    }

  private:
    const glm::dvec3& at(std::uint32_t v) const { return edit_.at(v); }
    const Triangle& triangle(std::uint32_t t) const { return edit_.mesh().triangles[t]; }
    double offAt(const glm::dvec3& p) const { return std::abs(valueAt(tape_(p), p)); }
    /// Cells are smaller where they were divided for a distance.
    double sideAt(const glm::dvec3& p) const { return limits_.most_off ? sharp_.sideAt(p) : step_; }
    MeshLimits limitsAt(std::uint32_t v) const { return limits_.within(at(v), 0.0); }
    double offBetween(const glm::dvec3& a, const glm::dvec3& b) const { return offAt(0.5 * (a + b)); }

    std::vector<Candidate> candidatesOf(const std::vector<std::uint32_t>& triangles, bool all) const {
        const auto add = [&](std::uint32_t t, std::vector<Candidate>& found) {
            for (int i = 0; i < 3; ++i) {
                std::uint32_t a = triangle(t)[i], b = triangle(t)[(i + 1) % 3];
                if (all && a > b) continue;  // the other triangle asks
                if (a > b) std::swap(a, b);
                if (isStuck(a) || isStuck(b)) continue;
                if (const double off = tooFarOff(a, b); off > 0.0) found.push_back({a, b, off});
            }
        };
        tbb::enumerable_thread_specific<std::vector<Candidate>> parts;
        tbb::parallel_for(std::size_t(0), triangles.size(),
                          [&](std::size_t n) { add(triangles[n], parts.local()); });
        std::vector<Candidate> found;
        for (const std::vector<Candidate>& part : parts) found.insert(found.end(), part.begin(), part.end());
        std::sort(found.begin(), found.end(), [](const Candidate& x, const Candidate& y) {
            return std::tie(y.off, x.a, x.b) < std::tie(x.off, y.a, y.b);
        });
        const auto same = [](const Candidate& x, const Candidate& y) { return x.a == y.a && x.b == y.b; };
        found.erase(std::unique(found.begin(), found.end(), same), found.end());
        return found;
    }
    glm::dvec3 middleOf(const Candidate& c) const { return 0.5 * (at(c.a) + at(c.b)); }
    /// Drops those in bricks where many edges are off.
    void leaveToSmallerCells(std::vector<Candidate>& candidates, std::vector<glm::dvec3>& left) const {
        std::vector<std::uint32_t> brick, count(sharp_.bricks() + 1, 0);
        for (const Candidate& c : candidates) {
            brick.push_back(std::min(sharp_.brickAt(middleOf(c)), sharp_.bricks()));
            ++count[brick.back()];
        }
        std::size_t kept = 0;
        for (std::size_t n = 0; n < candidates.size(); ++n)
            if (count[brick[n]] <= kMostInBrick || brick[n] == sharp_.bricks())
                candidates[kept++] = candidates[n];
            else
                left.push_back(middleOf(candidates[n]));
        candidates.resize(kept);
    }
    /// How far an edge is off, or 0 where that is within its limit. A sharp edge is further away than the
    /// surface is: where planes meet at an angle of 2 beta, what is d from both on their middle is d /
    /// sin(beta) from their line, and what is on one of them is not off at all.
    double tooFarOff(std::uint32_t a, std::uint32_t b) const {
        const glm::dvec3 middle = 0.5 * (at(a) + at(b));
        const double length = glm::distance(at(a), at(b)), side = sideAt(middle);
        if (length < kShortest * side) return 0.0;
        const MeshLimits limits = limits_.within(middle, 0.5 * length);
        const double off = limits_.most_off ? distanceBy(tape_, middle, limits.smooth) : offAt(middle);
        Diamond d;
        if (off > limits.smooth || !edit_.diamondOf(a, b, d)) return off > limits.smooth ? off : 0.0;
        if (isFolded(d)) {
            const double far = std::max(off, sharpEdgeFrom(d, limits.sharp));
            return far > limits.sharp ? far : 0.0;
        }
        if (off <= kNarrowest * limits.sharp) return 0.0;
        if (!sharp_.at(middle) && length <= kLong * side) return 0.0;
        return off > limits.sharp || off > limits.sharp * halfAngleSine(d) ? off : 0.0;
    }
    bool isFolded(const Diamond& d) const {
        const glm::dvec3 first = normalOf(d.sides[0]), second = normalOf(d.sides[1]);
        const double cosine = glm::dot(first, second);
        return cosine < 0.0 ||
               cosine * cosine < kFolded * kFolded * glm::dot(first, first) * glm::dot(second, second);
    }
    glm::dvec3 normalOf(std::uint32_t t) const {
        const auto& [a, b, c] = triangle(t);
        return glm::cross(at(b) - at(a), at(c) - at(a));
    }
    /// From its middle to the sharp edge of its two sides.
    double sharpEdgeFrom(const Diamond& d, double limit) const {
        const glm::dvec3 middle = 0.5 * (at(d.a) + at(d.b));
        const auto offTowards = [&](std::uint32_t tip) { return offAt(middle + kNear * (at(tip) - middle)); };
        if (std::max(offTowards(d.tips[0]), offTowards(d.tips[1])) < kOn * limit) return 0.0;
        std::vector<TangentPlane> planes;
        for (const std::uint32_t v : {d.a, d.b, d.tips[0], d.tips[1]})
            addPlane(tape_, middle + kByTip * (at(v) - middle), planes);
        if (planes.empty()) return 0.0;
        const FeaturePoint point = featurePoint(tape_, planes, middle, 0.5 * kReach * step_);
        return point.rank < 2 ? 0.0 : glm::distance(point.place_world, middle);
    }
    double halfAngleSine(const Diamond& d) const {
        const glm::dvec3 middle = 0.5 * (at(d.a) + at(d.b));
        std::array<glm::dvec3, 4> normals;
        double least = 1.0;
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t v = i == 0 ? d.a : i == 1 ? d.b : d.tips[i - 2];
            normals[i] = normalNear(tape_, middle + kByEnd * (at(v) - middle));
            for (std::size_t j = 0; j < i; ++j) least = std::min(least, glm::dot(normals[i], normals[j]));
        }
        return std::max(std::sqrt(std::max(0.5 * (1.0 + least), 0.0)), kNarrowest);
    }

    void touch(const Diamond& d) { touched_.insert(touched_.end(), {d.a, d.b, d.tips[0], d.tips[1]}); }

    void improve(const Candidate& c) {
        Diamond d;
        if (!edit_.diamondOf(c.a, c.b, d)) return;
        const Candidate now{c.a, c.b, tooFarOff(c.a, c.b)};  // others may have changed it
        if (now.off == 0.0) return;
        if (shouldTurn(d) && edit_.turn(d)) return touch(d);
        if (!isFolded(d) && isEven(d)) {
            if (divide(now, d, true) || shiftOff(c.a) || shiftOff(c.b)) return;
        } else if (shift(c.a) || shift(c.b) || divide(now, d, false)) {
            return;
        }
        if (draw(c.a) || draw(c.b)) return;
        stuck_.resize(edit_.mesh().position_world.size(), 0);
        ++stuck_[c.a], ++stuck_[c.b];
    }

    /// No sharp edge is near: along the edge, and between the tips, the normal turns evenly.
    bool isEven(const Diamond& d) const {
        const glm::dvec3 middle = 0.5 * (at(d.a) + at(d.b));
        const glm::dvec3 centre = normalNear(tape_, middle);
        const auto normal = [&](std::uint32_t v, double part) {
            return normalNear(tape_, middle + part * (at(v) - middle));
        };
        const std::array along{normal(d.a, kEnd), normal(d.a, kByEnd), centre, normal(d.b, kByEnd),
                               normal(d.b, kEnd)};
        constexpr std::array kAlong{kEnd - kByEnd, kByEnd, kByEnd, kEnd - kByEnd};
        if (!turnsEvenly(along, kAlong)) return false;
        const std::array across{normal(d.tips[0], kByEnd), centre, normal(d.tips[1], kByEnd)};
        return turnsEvenly(across, std::array{kByEnd, kByEnd});
    }
    static glm::dvec3 normalNear(const TapeAt& tape, const glm::dvec3& p) {
        const glm::dvec3 gradient = gradientAt(tape(p), p).gradient;
        const double length = glm::length(gradient);
        return length > 0.0 ? gradient / length : glm::dvec3(0.0);
    }
    /// `ways`: from each to the next.
    template <std::size_t N>
    static bool turnsEvenly(const std::array<glm::dvec3, N + 1>& normals, const std::array<double, N>& ways) {
        double turned = 0.0, way = 0.0;
        std::array<double, N> turns;
        for (std::size_t n = 0; n < N; ++n) {
            turns[n] = glm::distance(normals[n], normals[n + 1]);
            turned += turns[n], way += ways[n];
        }
        for (std::size_t n = 0; n < N; ++n)
            if (!(turns[n] <= kEven * turned * ways[n] / way + kSlight)) return false;
        return true;
    }
    void shiftBack(std::uint32_t v) {
        if (!edit_.around(v).empty() && offAt(at(v)) > kMended * limitsAt(v).sharp) shift(v);
    }
    bool shiftOff(std::uint32_t v) { return offAt(at(v)) > kOff * sideAt(at(v)) && shift(v); }

    /// How far the triangles around a vertex would be off the surface with it there.
    double offWith(std::uint32_t v, const glm::dvec3& p) const {
        double most = offAt(p);
        for (const std::uint32_t t : edit_.around(v)) {
            const auto [a, b] = othersOf(triangle(t), v);
            most = std::max({most, offBetween(p, at(a)), offAt((p + at(a) + at(b)) / 3.0)});
        }
        return most;
    }
    bool isStuck(std::uint32_t v) const { return v < stuck_.size() && stuck_[v] > kMostStuck; }
    bool tooOften(std::uint32_t v, std::vector<int>& tried) const {
        tried.resize(edit_.mesh().position_world.size(), 0);
        return tried[v]++ >= kMostShifts;
    }
    void touchAround(std::uint32_t v) {
        edit_.neighboursOf(v, neighbours_);
        touched_.insert(touched_.end(), neighbours_.begin(), neighbours_.end());
        touched_.push_back(v);
    }

    /// To the sharp edge or corner that its neighbourhood has, or to the surface, where that is nearer all
    /// around.
    bool shift(std::uint32_t v) {
        if (tooOften(v, shifts_)) return false;
        const glm::dvec3 from = at(v);
        const double most = kGain * offWith(v, from);
        double reach = kReach * step_;
        std::vector<TangentPlane> planes;
        for (const std::uint32_t t : edit_.around(v)) {
            const glm::dvec3 side = at(othersOf(triangle(t), v)[0]) - from;
            reach = std::max(reach, glm::length(side));
            for (const double part : {0.3, 0.7})
                if (planes.size() < kShiftPlanes) addPlane(tape_, from + part * side, planes);
        }
        std::vector<std::pair<double, glm::dvec3>> ways;
        const auto attempt = [&](const glm::dvec3& p) {
            if (!(glm::distance(p, from) <= reach)) return;
            if (const double off = offWith(v, p); off < most) ways.push_back({off, p});
        };
        if (!planes.empty()) attempt(featurePoint(tape_, planes, from, 0.5 * kReach * step_).place_world);
        attempt(onSurface(tape_, from));
        if (ways.size() == 2 && ways[1].first < ways[0].first) std::swap(ways[0], ways[1]);
        for (const auto& [off, p] : ways)
            for (const glm::dvec3& to : {p, 0.5 * (from + p)})
                if (offWith(v, to) < most && edit_.move(v, to)) return touchAround(v), true;
        return false;
    }

    /// A vertex into the neighbour that leaves what is nearest to the surface, and, if it was on it, does not
    /// leave its place.
    bool draw(std::uint32_t v) {
        if (tooOften(v, draws_)) return false;
        const bool on_surface = offAt(at(v)) <= limitsAt(v).sharp;
        const double most = kGain * offWith(v, at(v));
        edit_.neighboursOf(v, neighbours_);
        std::vector<std::pair<double, std::uint32_t>> ways;
        for (const std::uint32_t u : neighbours_)
            if (const double off = offDrawn(v, u); off < most && !(on_surface && leavesPlace(v, u, most)))
                ways.push_back({off, u});
        std::sort(ways.begin(), ways.end());
        for (std::size_t n = 0; n < std::min(ways.size(), kMostWays); ++n)
            if (edit_.collapse(v, ways[n].second)) return touchAround(ways[n].second), true;
        return false;
    }
    double offDrawn(std::uint32_t v, std::uint32_t u) const {
        double most = 0.0;
        for (const std::uint32_t t : edit_.around(v)) {
            if (holds(triangle(t), u)) continue;
            const auto [a, b] = othersOf(triangle(t), v);
            most = std::max({most, offBetween(at(u), at(a)), offBetween(at(u), at(b)), offOf(u, a, b)});
        }
        return most;
    }

    /// By more than so far.
    bool leavesPlace(std::uint32_t v, std::uint32_t u, double most) const {
        return std::none_of(edit_.around(v).begin(), edit_.around(v).end(), [&](std::uint32_t t) {
            const auto [a, b] = othersOf(triangle(t), v);
            return a != u && b != u && squaredDistance(at(v), at(u), at(a), at(b)) <= most * most;
        });
    }

    double offOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return offAt((at(a) + at(b) + at(c)) / 3.0);
    }
    double heightOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const double longest =
            std::max({glm::distance(at(a), at(b)), glm::distance(at(b), at(c)), glm::distance(at(c), at(a))});
        return glm::length(glm::cross(at(b) - at(a), at(c) - at(a))) / longest;
    }
    /// The other diagonal is nearer to the surface, and makes no slivers.
    bool shouldTurn(const Diamond& d) const {
        const auto [p, q] = d.tips;
        const double least = kLeastHeight * sideAt(0.5 * (at(d.a) + at(d.b)));
        if (heightOf(d.a, p, q) < least || heightOf(d.b, p, q) < least) return false;
        const double now = std::max({offBetween(at(d.a), at(d.b)), offOf(d.a, d.b, p), offOf(d.a, d.b, q)});
        const double then = std::max({offBetween(at(p), at(q)), offOf(d.a, p, q), offOf(d.b, p, q)});
        return then < kGain * now;
    }

    /// `even`: no sharp edge is near.
    bool divide(const Candidate& c, const Diamond& d, bool even) {
        const glm::dvec3 middle = 0.5 * (at(c.a) + at(c.b));
        for (const auto& [off, place] : placesFor(c, d.tips, even)) {
            const glm::dvec3 half = 0.5 * (middle + place);
            if (!edit_.divide(d, place) && !(offDivided(c, half) < kGain * c.off && edit_.divide(d, half)))
                continue;
            ++added_;
            touch(d);
            return true;
        }
        return false;
    }

    double offDivided(const Candidate& c, const glm::dvec3& p) const {
        return std::max({offAt(p), offBetween(p, at(c.a)), offBetween(p, at(c.b))});
    }
    /// The nearest first.
    std::vector<std::pair<double, glm::dvec3>> placesFor(const Candidate& c,
                                                         const std::array<std::uint32_t, 2>& tips,
                                                         bool even) const {
        const glm::dvec3 &a = at(c.a), &b = at(c.b), middle = 0.5 * (a + b);
        std::vector<std::pair<double, glm::dvec3>> found;
        double reach = kFarthest * glm::distance(a, b);
        const auto attempt = [&](const glm::dvec3& p) {
            if (glm::distance(p, middle) > reach) return;
            const double off = offDivided(c, p);
            if (off < kGain * c.off) found.push_back({off, p});
        };
        if (even || !sharp_.at(middle)) {
            attempt(onSurface(tape_, middle));
            if (!found.empty() || even) return found;
        }
        reach = std::max(reach, kReach * step_);
        const std::array<glm::dvec3, 4> ends{a, b, at(tips[0]), at(tips[1])};
        bool sharp = false;
        // Of the whole neighbourhood, and of the ends alone: the edge may be passed close to one of them.
        for (const auto& [count, parts] :
             {std::pair{4, std::array{0.25, 0.6}}, std::pair{2, std::array{0.8, 0.97}}}) {
            std::vector<TangentPlane> planes;
            for (int end = 0; end < count; ++end)
                for (const double part : parts) addPlane(tape_, middle + part * (ends[end] - middle), planes);
            if (planes.empty()) continue;
            const FeaturePoint point = featurePoint(tape_, planes, middle, 0.5 * kReach * step_);
            if (point.rank < 2) continue;
            sharp = true;
            attempt(point.place_world);
        }
        if (!sharp && c.off > limits_.within(middle, 0.5 * glm::distance(a, b)).smooth)
            attempt(onSurface(tape_, middle));
        std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
        return found;
    }
    static void addPlane(const TapeAt& tape, const glm::dvec3& near, std::vector<TangentPlane>& planes) {
        const glm::dvec3 p = onSurface(tape, near), gradient = gradientAt(tape(p), p).gradient;
        const double length = glm::length(gradient);
        if (length > 0.0 && std::isfinite(length)) planes.push_back({p, gradient / length});
    }

    MeshEdit edit_;
    const TapeAt& tape_;
    const double step_;
    const SharpCells& sharp_;
    const MeshLimits limits_;
    std::size_t added_ = 0;
    std::vector<int> shifts_, draws_, stuck_;  ///< how often vertices were asked to go elsewhere
    std::vector<std::uint32_t> touched_, neighbours_;
};

}  // namespace

std::size_t refineMesh(SurfaceMesh& mesh, const TapeAt& tape, double step, const SharpCells& sharp,
                       const MeshLimits& limits, std::vector<glm::dvec3>* left) {
    return Refiner(mesh, tape, step, sharp, limits).run(left);
}

}  // namespace edgewise::sdf
