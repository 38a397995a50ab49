#include "sdf/mesh_simplify.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace edgewise::sdf {
namespace {

constexpr double kFlat = 1e-9;
constexpr std::size_t kMostTriangles = 32;  ///< at a vertex
/// Least height over longest side of a triangle that a collapse makes.
constexpr double kLeastShape = 0.02;
constexpr int kPasses = 12;
constexpr std::uint32_t kGone = 0xffffffffu;

class Simplifier {
  public:
    Simplifier(SurfaceMesh& mesh, double step)
        : mesh_(mesh), flat_(kFlat * step), around_(mesh.position_world.size()), asked_(around_.size(), true) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            for (const std::uint32_t v : mesh.triangles[t]) around_[v].push_back(t);
    }

    std::size_t run() {
        std::size_t all = 0;
        for (int pass = 0; pass < kPasses; ++pass) {
            std::size_t gone = 0;
            for (std::uint32_t v = 0; v < around_.size(); ++v) {
                if (!asked_[v]) continue;
                asked_[v] = false;
                gone += collapse(v);
            }
            all += gone;
            if (gone == 0) break;
        }
        compact();
        return all;
    }

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
            if (!(length > 0.0)) return false;
            normals_.push_back(normal / length);
            for (const std::uint32_t w : mesh_.triangles[t])
                if (w != v && std::find(neighbours_.begin(), neighbours_.end(), w) == neighbours_.end())
                    neighbours_.push_back(w);
        }
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

    /// The worst shape that v's triangles get with it at u; 0 where one leaves its plane or turns over.
    double shapeWith(std::uint32_t v, std::uint32_t u, double least) const {
        double worst = 1.0;
        for (std::size_t n = 0; n < around_[v].size(); ++n) {
            Triangle t = mesh_.triangles[around_[v][n]];
            if (holds(t, u)) continue;
            if (std::abs(glm::dot(normals_[n], at(u) - at(v))) > flat_) return 0.0;
            std::replace(t.begin(), t.end(), v, u);
            const glm::dvec3 normal = normalOf(t);
            const double area = glm::dot(normal, normals_[n]);
            if (!(area > 0.0)) return 0.0;
            const auto length2 = [&](int i, int j) {
                const glm::dvec3 side = at(t[i]) - at(t[j]);
                return glm::dot(side, side);
            };
            worst = std::min(worst, area / std::max({length2(0, 1), length2(1, 2), length2(2, 0)}));
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
        (void)v;
        return common == 2 && around_[u].size() + around_[v].size() <= kMostTriangles + 4 && around_[v].size() > 2;
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
                around_[u].push_back(t);
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
            mesh_.material[kept++] = mesh_.material[t];
        }
        mesh_.triangles.resize(kept), mesh_.material.resize(kept);
        std::uint32_t count = 0;
        std::vector<std::uint32_t> number(around_.size(), kGone);
        for (std::uint32_t v = 0; v < around_.size(); ++v)
            if (!around_[v].empty()) number[v] = count, mesh_.position_world[count++] = mesh_.position_world[v];
        mesh_.position_world.resize(count);
        for (Triangle& t : mesh_.triangles)
            for (std::uint32_t& v : t) v = number[v];
    }

    SurfaceMesh& mesh_;
    const double flat_;
    std::vector<std::vector<std::uint32_t>> around_;
    std::vector<bool> asked_;
    std::vector<glm::dvec3> normals_;
    std::vector<std::uint32_t> neighbours_;
};

}  // namespace

std::size_t leaveOutFlat(SurfaceMesh& mesh, double step) {
    return Simplifier(mesh, step).run();
}

}  // namespace edgewise::sdf
