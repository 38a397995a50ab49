#include "sdf/mesh_refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/evaluate.h"
#include "sdf/mesh_embedding.h"
#include "sdf/mesh_feature.h"

namespace edgewise::sdf {
namespace {

constexpr int kRounds = 10, kRetreats = 12, kMostStuck = 2;
/// A new vertex is worth it when what is off becomes less than this part.
constexpr double kGain = 0.8;
/// Of an edge's length: from its middle to where it is divided.
constexpr double kFarthest = 1.0;
/// Of a cell's side: triangles that turned edges make are no narrower.
constexpr double kLeastHeight = 1e-3;

/// Of the way from an edge's middle to its ends: where normals are compared.
constexpr double kByEnd = 0.8, kEnd = 0.97;
/// Between sharp and round: of its share by length, a part turns no more than that and a little, which is
/// about the angle that mesh_feature tells apart.
constexpr double kEven = 1.5, kSlight = 0.03;
/// Of a cell's side: a vertex counts as on the surface.
constexpr double kOff = 1e-6;

constexpr int kMostShifts = 2;
constexpr std::size_t kShiftPlanes = 16;

struct Candidate {
    std::uint32_t a, b;
    double off;
};
struct Added {
    std::uint32_t vertex;
    glm::dvec3 middle;
    int retreats = 0;
};
struct Shifted {
    std::uint32_t vertex;
    glm::dvec3 from;
};
/// Two triangles' common edge a-b, and their other corners.
struct Diamond {
    std::uint32_t a, b;
    std::array<std::uint32_t, 2> sides, tips;
};

class Refiner {
  public:
    Refiner(SurfaceMesh& mesh, const TapeAt& tape, double step, const SharpCells& sharp,
            const MeshLimits& limits)
        : mesh_(mesh),
          tape_(tape),
          step_(step),
          sharp_(sharp),
          limits_(limits),
          around_(mesh.position_world.size()),
          stuck_(mesh.position_world.size(), 0) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (const std::uint32_t v : mesh.triangles[t]) around_[v].push_back(t);
    }

    std::size_t run() {
        std::vector<std::uint32_t> active(mesh_.triangles.size());
        for (std::uint32_t t = 0; t < active.size(); ++t) active[t] = t;
        std::size_t all = 0;
        for (int round = 0; round < kRounds && !active.empty(); ++round) {
            const SurfaceMesh before = mesh_;
            touched_.assign(mesh_.triangles.size(), false);
            added_.clear(), turned_.clear(), shifted_.clear();
            std::vector<std::uint32_t> later;
            for (const Candidate& c : candidatesOf(active)) improve(c, later);
            all += added_.size();
            if (added_.empty() && turned_.empty() && shifted_.empty()) break;
            if (!retreat()) {
                mesh_ = before;
                break;
            }
            active = std::move(later);
            for (std::uint32_t t = 0; t < touched_.size(); ++t)
                if (touched_[t]) active.push_back(t);
            std::sort(active.begin(), active.end());
            active.erase(std::unique(active.begin(), active.end()), active.end());
        }
        return all;
    }

  private:
    const glm::dvec3& at(std::uint32_t v) const { return mesh_.position_world[v]; }
    double offBetween(const glm::dvec3& a, const glm::dvec3& b) const {
        const glm::dvec3 middle = 0.5 * (a + b);
        return std::abs(valueAt(tape_(middle), middle));
    }

    std::vector<Candidate> candidatesOf(const std::vector<std::uint32_t>& triangles) const {
        std::vector<Candidate> found;
        for (const std::uint32_t t : triangles)
            for (int i = 0; i < 3; ++i) {
                std::uint32_t a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
                if (stuck_[a] > kMostStuck || stuck_[b] > kMostStuck) continue;
                if (a > b) std::swap(a, b);
                const double off = offBetween(at(a), at(b));
                if (off > limits_.smooth || (off > limits_.sharp && sharp_.at(0.5 * (at(a) + at(b)))))
                    found.push_back({a, b, off});
            }
        std::sort(found.begin(), found.end(), [](const Candidate& x, const Candidate& y) {
            return std::tie(y.off, x.a, x.b) < std::tie(x.off, y.a, y.b);
        });
        const auto same = [](const Candidate& x, const Candidate& y) { return x.a == y.a && x.b == y.b; };
        found.erase(std::unique(found.begin(), found.end(), same), found.end());
        return found;
    }

    static std::uint32_t third(const Triangle& t, std::uint32_t a, std::uint32_t b) {
        return t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
    }

    /// False: the edge has not two triangles.
    bool diamondOf(std::uint32_t a, std::uint32_t b, Diamond& d) const {
        d.a = a, d.b = b;
        std::size_t count = 0;
        for (const std::uint32_t t : around_[a])
            if (holds(mesh_.triangles[t], b) && count < 2) d.sides[count++] = t;
        if (count != 2) return false;
        for (int i = 0; i < 2; ++i) d.tips[i] = third(mesh_.triangles[d.sides[i]], a, b);
        return d.tips[0] != d.tips[1];
    }
    static bool holds(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }
    bool isEdge(std::uint32_t a, std::uint32_t b) const {
        return std::any_of(around_[a].begin(), around_[a].end(),
                           [&](std::uint32_t t) { return holds(mesh_.triangles[t], b); });
    }

    void improve(const Candidate& c, std::vector<std::uint32_t>& later) {
        Diamond d;
        if (!diamondOf(c.a, c.b, d)) return;
        if (touched_[d.sides[0]] || touched_[d.sides[1]]) {
            later.insert(later.end(), d.sides.begin(), d.sides.end());
            return;
        }
        if (shouldTurn(c, d))
            turn(d), turned_.push_back(d);
        else if (!isEven(d))
            divide(c, d, false) || shift(c.a) || shift(c.b);
        else
            (c.off > limits_.smooth && divide(c, d, true)) || shiftOff(c.a) || shiftOff(c.b);
    }

    /// No sharp edge is near: along the edge, and between the tips, the normal turns evenly.
    bool isEven(const Diamond& d) const {
        const glm::dvec3 middle = 0.5 * (at(d.a) + at(d.b));
        const TapeView tape = tape_(middle);
        const glm::dvec3 centre = normalNear(tape, middle);
        const auto normal = [&](std::uint32_t v, double part) {
            return normalNear(tape, middle + part * (at(v) - middle));
        };
        const std::array along{normal(d.a, kEnd), normal(d.a, kByEnd), centre, normal(d.b, kByEnd),
                               normal(d.b, kEnd)};
        constexpr std::array kAlong{kEnd - kByEnd, kByEnd, kByEnd, kEnd - kByEnd};
        if (!turnsEvenly(along, kAlong)) return false;
        const std::array across{normal(d.tips[0], kByEnd), centre, normal(d.tips[1], kByEnd)};
        return turnsEvenly(across, std::array{kByEnd, kByEnd});
    }
    static glm::dvec3 normalNear(const TapeView& tape, const glm::dvec3& p) {
        const glm::dvec3 gradient = gradientAt(tape, p).gradient;
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
    bool shiftOff(std::uint32_t v) {
        return std::abs(valueAt(tape_(at(v)), at(v))) > kOff * step_ && shift(v);
    }

    /// How far the triangles around a vertex would be off the surface with it there.
    double offWith(std::uint32_t v, const glm::dvec3& p) const {
        double most = std::abs(valueAt(tape_(p), p));
        for (const std::uint32_t t : around_[v]) {
            const auto [a, b] = othersOf(mesh_.triangles[t], v);
            const glm::dvec3 centre = (p + at(a) + at(b)) / 3.0;
            most = std::max({most, offBetween(p, at(a)), std::abs(valueAt(tape_(centre), centre))});
        }
        return most;
    }
    /// In the triangle's order.
    static std::array<std::uint32_t, 2> othersOf(const Triangle& t, std::uint32_t v) {
        return t[0] == v   ? std::array{t[1], t[2]}
               : t[1] == v ? std::array{t[2], t[0]}
                           : std::array{t[0], t[1]};
    }
    /// To the sharp edge or corner that its neighbourhood has, or to the surface, where that is nearer all
    /// around.
    bool shift(std::uint32_t v) {
        for (const std::uint32_t t : around_[v])
            if (touched_[t]) return false;
        tried_.resize(mesh_.position_world.size(), 0);
        if (tried_[v]++ >= kMostShifts) return false;
        const glm::dvec3 from = at(v);
        const TapeView tape = tape_(from);
        double best = kGain * offWith(v, from), reach = 0.0;
        glm::dvec3 to = from;
        std::vector<TangentPlane> planes;
        for (const std::uint32_t t : around_[v]) {
            const glm::dvec3 side = at(othersOf(mesh_.triangles[t], v)[0]) - from;
            reach = std::max(reach, glm::length(side));
            for (const double part : {0.3, 0.7})
                if (planes.size() < kShiftPlanes) addPlane(tape, from + part * side, planes);
        }
        const auto attempt = [&](const glm::dvec3& p) {
            if (!(glm::distance(p, from) <= reach)) return;
            if (const double off = offWith(v, p); off < best) best = off, to = p;
        };
        if (!planes.empty()) attempt(featurePoint(tape, planes, from, step_).place_world);
        attempt(onSurface(tape, from));
        if (to == from) return false;
        shifted_.push_back({v, from});
        mesh_.position_world[v] = to;
        for (const std::uint32_t t : around_[v]) touched_[t] = true;
        return true;
    }

    double offOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const glm::dvec3 centre = (at(a) + at(b) + at(c)) / 3.0;
        return std::abs(valueAt(tape_(centre), centre));
    }
    double heightOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const double longest =
            std::max({glm::distance(at(a), at(b)), glm::distance(at(b), at(c)), glm::distance(at(c), at(a))});
        return glm::length(glm::cross(at(b) - at(a), at(c) - at(a))) / longest;
    }
    /// The other diagonal is nearer to the surface, and makes no slivers nor folds.
    bool shouldTurn(const Candidate& c, const Diamond& d) const {
        const auto [p, q] = d.tips;
        if (isEdge(p, q) || wasTurned(p, q)) return false;
        const double least = kLeastHeight * step_;
        if (heightOf(d.a, p, q) < least || heightOf(d.b, p, q) < least) return false;
        const double now = std::max({c.off, offOf(d.a, d.b, p), offOf(d.a, d.b, q)});
        const double then = std::max({offBetween(at(p), at(q)), offOf(d.a, p, q), offOf(d.b, p, q)});
        return then < kGain * now;
    }
    bool wasTurned(std::uint32_t p, std::uint32_t q) const {
        return std::any_of(turned_.begin(), turned_.end(), [&](const Diamond& d) {
            return (d.a == p && d.b == q) || (d.a == q && d.b == p);
        });
    }
    /// The edge between the tips in the place of a-b.
    void turn(const Diamond& d) {
        const auto [s, t] = d.sides;
        const auto [p, q] = d.tips;
        std::replace(mesh_.triangles[s].begin(), mesh_.triangles[s].end(), d.b, q);
        std::replace(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), d.a, p);
        std::erase(around_[d.b], s), std::erase(around_[d.a], t);
        around_[q].push_back(s), around_[p].push_back(t);
        touched_[s] = touched_[t] = true;
    }

    /// `even`: no sharp edge is near.
    bool divide(const Candidate& c, const Diamond& d, bool even) {
        glm::dvec3 place;
        if (!placeFor(c, d.tips, even, place)) return false;
        const auto v = static_cast<std::uint32_t>(mesh_.position_world.size());
        mesh_.position_world.push_back(place);
        around_.emplace_back(), stuck_.push_back(0);
        added_.push_back({v, 0.5 * (at(c.a) + at(c.b))});
        for (int i = 0; i < 2; ++i) splitTriangle(d.sides[i], c.a, c.b, d.tips[i], v);
        return true;
    }

    /// The half at b becomes a triangle of its own.
    void splitTriangle(std::uint32_t t, std::uint32_t a, std::uint32_t b, std::uint32_t tip,
                       std::uint32_t v) {
        const auto half = static_cast<std::uint32_t>(mesh_.triangles.size());
        Triangle other = mesh_.triangles[t];
        std::replace(other.begin(), other.end(), a, v);
        mesh_.triangles.push_back(other);
        std::replace(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), b, v);
        std::replace(around_[b].begin(), around_[b].end(), t, half);
        around_[tip].push_back(half);
        around_[v].push_back(t), around_[v].push_back(half);
        touched_[t] = true, touched_.push_back(true);
    }

    bool placeFor(const Candidate& c, const std::array<std::uint32_t, 2>& tips, bool even,
                  glm::dvec3& place) const {
        const glm::dvec3 &a = at(c.a), &b = at(c.b), middle = 0.5 * (a + b);
        const TapeView tape = tape_(middle);
        double best = kGain * c.off;
        bool found = false;
        const auto attempt = [&](const glm::dvec3& p) {
            if (glm::distance(p, middle) > kFarthest * glm::distance(a, b)) return;
            const double off = std::max({std::abs(valueAt(tape, p)), offBetween(p, a), offBetween(p, b)});
            if (off < best) best = off, place = p, found = true;
        };
        if (even || !sharp_.at(middle)) {
            attempt(onSurface(tape, middle));
            if (found || even) return found;
        }
        const std::array<glm::dvec3, 4> ends{a, b, at(tips[0]), at(tips[1])};
        bool sharp = false;
        // Of the whole neighbourhood, and of the ends alone: the edge may be passed close to one of them.
        for (const auto& [count, parts] :
             {std::pair{4, std::array{0.25, 0.6}}, std::pair{2, std::array{0.8, 0.97}}}) {
            std::vector<TangentPlane> planes;
            for (int end = 0; end < count; ++end)
                for (const double part : parts) addPlane(tape, middle + part * (ends[end] - middle), planes);
            if (planes.empty()) continue;
            const FeaturePoint point = featurePoint(tape, planes, middle, step_);
            if (point.rank < 2) continue;
            sharp = true;
            attempt(point.place_world);
        }
        if (!sharp && c.off > limits_.smooth) attempt(onSurface(tape, middle));
        return found;
    }
    static void addPlane(const TapeView& tape, const glm::dvec3& near, std::vector<TangentPlane>& planes) {
        const glm::dvec3 p = onSurface(tape, near), gradient = gradientAt(tape, p).gradient;
        const double length = glm::length(gradient);
        if (length > 0.0 && std::isfinite(length)) planes.push_back({p, gradient / length});
    }

    /// New vertices whose triangles meet others go back to where they change nothing, edges turn back.
    /// False: some still do.
    bool retreat() {
        for (int n = 0; n < kRetreats; ++n) {
            const auto pairs = meetingPairs(mesh_.position_world, mesh_.triangles, touched_);
            if (pairs.empty()) return true;
            shiftBack(pairs);
            turnBack(pairs);
            std::vector<std::uint32_t> back;
            const std::uint32_t first = added_.empty() ? 0xffffffffu : added_.front().vertex;
            for (const auto& [s, t] : pairs)
                for (const std::uint32_t triangle : {s, t})
                    for (const std::uint32_t v : mesh_.triangles[triangle])
                        if (v >= first) back.push_back(v - first);
            std::sort(back.begin(), back.end());
            back.erase(std::unique(back.begin(), back.end()), back.end());
            for (const std::uint32_t i : back) {
                Added& added = added_[i];
                glm::dvec3& place = mesh_.position_world[added.vertex];
                ++stuck_[added.vertex];
                place = ++added.retreats == 1 ? 0.5 * (place + added.middle) : added.middle;
            }
        }
        return meetingPairs(mesh_.position_world, mesh_.triangles, touched_).empty();
    }

    void shiftBack(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
        std::erase_if(shifted_, [&](const Shifted& s) {
            const auto own = [&](std::uint32_t t) { return holds(mesh_.triangles[t], s.vertex); };
            if (std::none_of(pairs.begin(), pairs.end(),
                             [&](const auto& pair) { return own(pair.first) || own(pair.second); }))
                return false;
            mesh_.position_world[s.vertex] = s.from;
            ++stuck_[s.vertex];
            return true;
        });
    }
    void turnBack(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
        std::vector<std::uint32_t> meeting;
        for (const auto& [s, t] : pairs) meeting.push_back(s), meeting.push_back(t);
        std::sort(meeting.begin(), meeting.end());
        const auto meets = [&](std::uint32_t t) {
            return std::binary_search(meeting.begin(), meeting.end(), t);
        };
        std::erase_if(turned_, [&](const Diamond& d) {
            if (!meets(d.sides[0]) && !meets(d.sides[1])) return false;
            // Seen from the other diagonal: its ends are the tips, each side's third corner an end.
            turn({d.tips[0], d.tips[1], d.sides, {d.a, d.b}});
            ++stuck_[d.a], ++stuck_[d.b];
            return true;
        });
    }

    SurfaceMesh& mesh_;
    const TapeAt& tape_;
    const double step_;
    const SharpCells& sharp_;
    const MeshLimits limits_;
    std::vector<std::vector<std::uint32_t>> around_;
    std::vector<int> tried_;     ///< how often vertices were asked to shift
    std::vector<int> stuck_;     ///< how often vertices could not go where they belong
    std::vector<bool> touched_;  ///< triangles of this round
    std::vector<Added> added_;
    std::vector<Diamond> turned_;
    std::vector<Shifted> shifted_;
};

}  // namespace

std::size_t refineMesh(SurfaceMesh& mesh, const TapeAt& tape, double step, const SharpCells& sharp,
                       const MeshLimits& limits) {
    mesh.material.clear(), mesh.normal_world.clear();
    return Refiner(mesh, tape, step, sharp, limits).run();
}

}  // namespace edgewise::sdf
