#include "sdf/mesh_simplify.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <optional>
#include <tuple>

#include "sdf/evaluate.h"
#include "sdf/mesh_embedding.h"
#include "sdf/surface_distance.h"
#include "sdf/triangle_tree.h"

namespace edgewise::sdf {
namespace {

constexpr double kFlat = 1e-9;
constexpr std::size_t kMostTriangles = 32;  ///< at a vertex
/// Least height over longest side of a triangle that a collapse makes.
constexpr double kLeastShape = 0.02;
/// Of a triangle whose normal is to be trusted.
constexpr double kLeastOwnShape = 1e-4;
/// Cosine between normals of triangles in one plane, on the same side of it.
constexpr double kSamePlane = 1.0 - 1e-9;
constexpr int kPasses = 12, kAttempts = 8;
/// Of a triangle's size: how far around it vertices are kept where it met another, at first.
constexpr double kAround = 0.5;
/// Of curved parts.
constexpr double kLeastNearShape = 0.2;
constexpr std::size_t kMostWays = 3;
/// Cosines: by how much a triangle may turn; up to which angle what is around a vertex is smooth.
constexpr double kLeastTurn = 0.8, kSmooth = 0.9;
constexpr std::uint32_t kGone = 0xffffffffu;

struct NearSurface {
    const TapeAt& tape;
    MeshLimits limits;
};

class Simplifier {
  public:
    /// `near`: off planes by a little, but the surface's own; none: flat parts alone.
    Simplifier(SurfaceMesh& mesh, double step, const std::vector<bool>& kept,
               const NearSurface* near = nullptr)
        : mesh_(mesh),
          kept_(kept),
          near_(near),
          flat_(kFlat * step),
          around_(mesh.position_world.size()),
          asked_(around_.size(), true),
          changed_(mesh.triangles.size(), false) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (const std::uint32_t v : mesh.triangles[t]) around_[v].push_back(t);
    }

    std::size_t run() {
        std::size_t all = 0;
        for (int pass = 0; pass < kPasses; ++pass) {
            std::size_t gone = 0;
            for (std::uint32_t v = 0; v < around_.size(); ++v) {
                if (!asked_[v] || kept_[v]) continue;
                asked_[v] = false;
                gone += collapse(v);
            }
            all += gone;
            if (gone == 0) break;
        }
        compact();
        return all;
    }

    /// Triangles that are not what they were.
    const std::vector<bool>& changed() const { return changed_; }

  private:
    const glm::dvec3& at(std::uint32_t v) const { return mesh_.position_world[v]; }

    glm::dvec3 normalOf(const Triangle& t) const {
        return glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    }
    static bool holds(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

    /// Into the neighbour that leaves the best shapes.
    bool collapse(std::uint32_t v) {
        const std::vector<std::uint32_t>& own = around_[v];
        if (own.empty() || own.size() > kMostTriangles) return false;
        for (const std::uint32_t t : own)
            if (mesh_.material[t] != mesh_.material[own[0]]) return false;
        normals_.clear(), neighbours_.clear();
        for (const std::uint32_t t : own) {
            const glm::dvec3 normal = normalOf(mesh_.triangles[t]);
            const double length = glm::length(normal);
            if (!(length > kLeastOwnShape * longest2(mesh_.triangles[t]))) return false;
            normals_.push_back(normal / length);
            for (const std::uint32_t w : mesh_.triangles[t])
                if (w != v && std::find(neighbours_.begin(), neighbours_.end(), w) == neighbours_.end())
                    neighbours_.push_back(w);
        }
        if (near_) return collapseNear(v);
        double best = kLeastShape;
        std::uint32_t into = kGone;
        for (const std::uint32_t u : neighbours_) {
            const double shape = shapeWith(v, u, best);
            if (shape > best && linked(v, u)) best = shape, into = u;
        }
        if (into == kGone) return false;
        draw(v, into);
        return true;
    }

    /// As long as the surface stays near, and what was there too: first into the neighbours that leave the
    /// best shapes.
    bool collapseNear(std::uint32_t v) {
        std::vector<std::pair<double, std::uint32_t>> ways;
        for (const std::uint32_t u : neighbours_)
            if (const double shape = shapeNear(v, u); shape > kLeastNearShape) ways.push_back({-shape, u});
        std::sort(ways.begin(), ways.end());
        if (ways.size() > kMostWays) ways.resize(kMostWays);
        for (const auto& [shape, u] : ways)
            if (linked(v, u) && staysNear(v, u)) return draw(v, u), true;
        return false;
    }
    double shapeNear(std::uint32_t v, std::uint32_t u) const {
        double worst = 1.0;
        for (std::size_t n = 0; n < around_[v].size() && worst > kLeastNearShape; ++n) {
            Triangle t = mesh_.triangles[around_[v][n]];
            if (holds(t, u)) continue;
            std::replace(t.begin(), t.end(), v, u);
            const glm::dvec3 normal = normalOf(t);
            const double area = glm::length(normal);
            if (!(glm::dot(normal, normals_[n]) > kLeastTurn * area)) return 0.0;
            worst = std::min(worst, area / longest2(t));
        }
        return worst;
    }
    bool staysNear(std::uint32_t v, std::uint32_t u) {
        double bent = 1.0;
        for (const glm::dvec3& normal : normals_) bent = std::min(bent, glm::dot(normal, normals_[0]));
        const bool smooth = bent > kSmooth;
        fan_.clear();
        for (const std::uint32_t n : around_[v]) {
            Triangle t = mesh_.triangles[n];
            if (holds(t, u)) continue;
            std::replace(t.begin(), t.end(), v, u);
            fan_.push_back(t);
            const glm::dvec3 centre = (at(t[0]) + at(t[1]) + at(t[2])) / 3.0;
            if (isOff(centre,
                      limitFor(centre,
                               std::max({glm::distance(centre, at(t[0])), glm::distance(centre, at(t[1])),
                                         glm::distance(centre, at(t[2]))}),
                               smooth)))
                return false;
        }
        for (const std::uint32_t w : neighbours_)
            if (const glm::dvec3 middle = 0.5 * (at(u) + at(w));
                w != u && isOff(middle, limitFor(middle, glm::distance(middle, at(u)), smooth)))
                return false;
        const double limit = limitFor(at(v), 0.0, smooth);
        if (near_->limits.most_off && !smooth) return staysByLeft(v, limit);
        if (isLeft(at(v), limit)) return false;
        return std::none_of(neighbours_.begin(), neighbours_.end(),
                            [&](std::uint32_t w) { return isLeft(0.5 * (at(v) + at(w)), limit); });
    }
    /// By a sharp edge, which the field's value does not tell from its sides: what has gone before counts
    /// too.
    bool staysByLeft(std::uint32_t v, double limit) {
        double most = distanceFrom(at(v));
        for (const std::uint32_t w : neighbours_) most = std::max(most, distanceFrom(0.5 * (at(v) + at(w))));
        left_.resize(around_.size(), 0.0);
        const double sum = left_[v] + most;
        if (sum > limit) return false;
        for (const std::uint32_t w : neighbours_) left_[w] = std::max(left_[w], sum);
        return true;
    }
    double distanceFrom(const glm::dvec3& p) const {
        double least2 = HUGE_VAL;
        for (const Triangle& t : fan_)
            least2 = std::min(least2, squaredDistance(p, at(t[0]), at(t[1]), at(t[2])));
        return std::sqrt(least2);
    }
    bool isOff(const glm::dvec3& p, double limit) const {
        if (near_->limits.most_off) return distanceBy(near_->tape, p, limit) > limit;
        return std::abs(valueAt(near_->tape(p), p)) > limit;
    }
    double limitFor(const glm::dvec3& p, double radius, bool smooth) const {
        const MeshLimits limits = near_->limits.within(p, radius);
        return smooth ? limits.smooth : limits.sharp;
    }
    /// The new triangles are further away from what was there.
    bool isLeft(const glm::dvec3& p, double limit) const {
        return std::none_of(fan_.begin(), fan_.end(), [&](const Triangle& t) {
            return squaredDistance(p, at(t[0]), at(t[1]), at(t[2])) <= limit * limit;
        });
    }

    double longest2(const Triangle& t) const {
        const auto length2 = [&](int i, int j) {
            const glm::dvec3 side = at(t[i]) - at(t[j]);
            return glm::dot(side, side);
        };
        return std::max({length2(0, 1), length2(1, 2), length2(2, 0)});
    }

    /// A triangle that goes lies in the plane of one that stays, the same side up: no fold is lost with it.
    bool spread(std::uint32_t v, std::uint32_t u, std::size_t n) const {
        for (std::size_t m = 0; m < around_[v].size(); ++m)
            if (!holds(mesh_.triangles[around_[v][m]], u) && glm::dot(normals_[m], normals_[n]) > kSamePlane)
                return true;
        return false;
    }

    /// The worst shape that v's triangles get with it at u; 0 where one leaves its plane or turns over.
    double shapeWith(std::uint32_t v, std::uint32_t u, double least) const {
        double worst = 1.0;
        for (std::size_t n = 0; n < around_[v].size(); ++n) {
            Triangle t = mesh_.triangles[around_[v][n]];
            if (holds(t, u)) {
                if (!spread(v, u, n)) return 0.0;
                continue;
            }
            if (std::abs(glm::dot(normals_[n], at(u) - at(v))) > flat_) return 0.0;
            std::replace(t.begin(), t.end(), v, u);
            const glm::dvec3 normal = normalOf(t);
            const double area = glm::dot(normal, normals_[n]);
            if (!(area > 0.0)) return 0.0;
            worst = std::min(worst, area / longest2(t));
            if (worst <= least) return 0.0;
        }
        return worst;
    }

    /// The edge's ends have two neighbours in common, no more: else the mesh would touch itself.
    bool linked(std::uint32_t v, std::uint32_t u) const {
        int common = 0;
        for (const std::uint32_t w : neighbours_) {
            if (w == u) continue;
            common += std::any_of(around_[u].begin(), around_[u].end(),
                                  [&](std::uint32_t t) { return holds(mesh_.triangles[t], w); });
        }
        return common == 2 && around_[u].size() + around_[v].size() <= kMostTriangles + 4;
    }

    void draw(std::uint32_t v, std::uint32_t u) {
        for (const std::uint32_t t : around_[v]) {
            Triangle& triangle = mesh_.triangles[t];
            if (holds(triangle, u)) {
                for (const std::uint32_t w : triangle)
                    if (w != v) std::erase(around_[w], t);
                triangle = {kGone, kGone, kGone};
            } else {
                std::replace(triangle.begin(), triangle.end(), v, u);
                around_[u].push_back(t), changed_[t] = true;
            }
        }
        around_[v].clear();
        asked_[u] = true;
        for (const std::uint32_t w : neighbours_) asked_[w] = true;
    }

    void compact() {
        std::size_t kept = 0;
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (mesh_.triangles[t][0] == kGone) continue;
            mesh_.triangles[kept] = mesh_.triangles[t];
            changed_[kept] = changed_[t];
            mesh_.material[kept++] = mesh_.material[t];
        }
        mesh_.triangles.resize(kept), mesh_.material.resize(kept), changed_.resize(kept);
        std::uint32_t count = 0;
        std::vector<std::uint32_t> number(around_.size(), kGone);
        for (std::uint32_t v = 0; v < around_.size(); ++v)
            if (!around_[v].empty())
                number[v] = count, mesh_.position_world[count++] = mesh_.position_world[v];
        mesh_.position_world.resize(count);
        for (Triangle& t : mesh_.triangles)
            for (std::uint32_t& v : t) v = number[v];
    }

    SurfaceMesh& mesh_;
    const std::vector<bool>& kept_;
    const NearSurface* near_;
    const double flat_;
    std::vector<Triangle> fan_;
    std::vector<double> left_;  ///< by vertex: how far sharp edges around have moved
    std::vector<std::vector<std::uint32_t>> around_;
    std::vector<bool> asked_, changed_;
    std::vector<glm::dvec3> normals_;
    std::vector<std::uint32_t> neighbours_;
};

/// Vertices in the order of their first coordinates.
class VertexOrder {
  public:
    explicit VertexOrder(const std::vector<glm::dvec3>& x) : x_(x), order_(x.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::tie(x_[a].x, a) < std::tie(x_[b].x, b);
        });
    }
    /// Those within a box.
    template <class F>
    void forWithin(const glm::dvec3& low, const glm::dvec3& high, const F& f) const {
        auto at = std::partition_point(order_.begin(), order_.end(),
                                       [&](std::uint32_t v) { return x_[v].x <= low.x; });
        for (; at != order_.end() && x_[*at].x < high.x; ++at)
            if (glm::all(glm::lessThan(low, x_[*at])) && glm::all(glm::lessThan(x_[*at], high))) f(*at);
    }

  private:
    const std::vector<glm::dvec3>& x_;
    std::vector<std::uint32_t> order_;
};

/// Keeps the whole mesh's vertices around a triangle of `mesh`, `around` of its size away too.
void keepAround(const SurfaceMesh& mesh, const Triangle& t, const VertexOrder& whole, double around,
                std::vector<bool>& kept) {
    const auto &a = mesh.position_world[t[0]], &b = mesh.position_world[t[1]], &c = mesh.position_world[t[2]];
    const glm::dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c)), size = high - low;
    const double margin = around * std::max({size.x, size.y, size.z});
    whole.forWithin(low - margin, high + margin, [&](std::uint32_t v) { kept[v] = true; });
}

std::size_t simplify(SurfaceMesh& mesh, double step, const NearSurface* near) {
    const SurfaceMesh whole = mesh;
    std::vector<bool> kept(whole.position_world.size(), false);
    std::optional<VertexOrder> order;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        Simplifier simplifier(mesh, step, kept, near);
        const std::size_t gone = simplifier.run();
        const auto pairs = meetingPairs(mesh.position_world, mesh.triangles, simplifier.changed());
        if (pairs.empty()) return gone;
        std::vector<std::uint32_t> around;
        for (const auto& [a, b] : pairs) around.push_back(a), around.push_back(b);
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        if (!order) order.emplace(whole.position_world);
        for (const std::uint32_t t : around)
            keepAround(mesh, mesh.triangles[t], *order, kAround * (attempt + 1) * (attempt + 1), kept);
        mesh = whole;
    }
    return 0;
}

}  // namespace

std::size_t leaveOutFlat(SurfaceMesh& mesh, double step) {
    return simplify(mesh, step, nullptr);
}

std::size_t thinOut(SurfaceMesh& mesh, const TapeAt& tape, double step, const MeshLimits& limits) {
    const NearSurface near{tape, limits};
    return simplify(mesh, step, &near);
}

}  // namespace edgewise::sdf
