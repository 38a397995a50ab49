#include "sdf/mesh_edit.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "sdf/mesh_embedding.h"

namespace edgewise::sdf {

MeshEdit::MeshEdit(SurfaceMesh& mesh, double size)
    : mesh_(mesh),
      scale_(1.0 / size),
      around_(mesh.position_world.size()),
      cells_(std::bit_ceil(mesh.triangles.size() + 1)) {
    mesh.material.clear(), mesh.normal_world.clear();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) around_[v].push_back(t);
        put(t);
    }
}

template <class F>
void MeshEdit::forCells(const Triangle& t, const F& f) const {
    const glm::dvec3 &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
    const glm::i64vec3 low(glm::floor(glm::min(a, glm::min(b, c)) * scale_)),
        high(glm::floor(glm::max(a, glm::max(b, c)) * scale_));
    for (std::int64_t z = low.z; z <= high.z; ++z)
        for (std::int64_t y = low.y; y <= high.y; ++y)
            for (std::int64_t x = low.x; x <= high.x; ++x) {
                // Primes (Teschner et al. 2003).
                const auto hash = static_cast<std::uint64_t>(x * 73856093 ^ y * 19349663 ^ z * 83492791);
                if (!f(static_cast<std::size_t>(hash & (cells_.size() - 1)))) return;
            }
}
void MeshEdit::put(std::uint32_t t) {
    forCells(mesh_.triangles[t], [&](std::size_t cell) { return cells_[cell].push_back(t), true; });
}
void MeshEdit::take(std::uint32_t t) {
    forCells(mesh_.triangles[t], [&](std::size_t cell) {
        const auto found = std::find(cells_[cell].begin(), cells_[cell].end(), t);
        *found = cells_[cell].back(), cells_[cell].pop_back();
        return true;
    });
}
bool MeshEdit::meets(const Triangle& t) const {
    bool found = false;
    forCells(t, [&](std::size_t cell) {
        for (const std::uint32_t other : cells_[cell])
            if (trianglesMeet(mesh_.position_world, t, mesh_.triangles[other])) return found = true, false;
        return true;
    });
    return found;
}

bool MeshEdit::replace(std::span<const std::uint32_t> gone, std::span<const Triangle> next) {
    for (const std::uint32_t t : gone) take(t);
    bool met = std::any_of(next.begin(), next.end(), [&](const Triangle& t) { return meets(t); });
    for (std::size_t n = 0; n < next.size() && !met; ++n)
        for (std::size_t m = 0; m < n && !met; ++m)
            met = trianglesMeet(mesh_.position_world, next[n], next[m]);
    if (met) {
        for (const std::uint32_t t : gone) put(t);
        return false;
    }
    for (const std::uint32_t t : gone) {
        for (const std::uint32_t v : mesh_.triangles[t]) std::erase(around_[v], t);
        mesh_.triangles[t] = {kGone, kGone, kGone};
    }
    for (std::size_t n = 0; n < next.size(); ++n) {
        const auto t = n < gone.size() ? gone[n] : static_cast<std::uint32_t>(mesh_.triangles.size());
        if (n >= gone.size()) mesh_.triangles.emplace_back();
        mesh_.triangles[t] = next[n];
        for (const std::uint32_t v : next[n]) around_[v].push_back(t);
        put(t);
    }
    return true;
}

bool MeshEdit::isEdge(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(around_[a].begin(), around_[a].end(),
                       [&](std::uint32_t t) { return holds(mesh_.triangles[t], b); });
}

bool MeshEdit::diamondOf(std::uint32_t a, std::uint32_t b, Diamond& d) const {
    d.a = a, d.b = b;
    std::size_t count = 0;
    for (const std::uint32_t t : around_[a]) {
        if (!holds(mesh_.triangles[t], b)) continue;
        if (count == 2) return false;
        const auto [c, e] = othersOf(mesh_.triangles[t], a);
        d.sides[count] = t, d.tips[count++] = c == b ? e : c;
    }
    return count == 2 && d.tips[0] != d.tips[1];
}

void MeshEdit::neighboursOf(std::uint32_t v, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (const std::uint32_t t : around_[v])
        for (const std::uint32_t w : othersOf(mesh_.triangles[t], v))
            if (std::find(out.begin(), out.end(), w) == out.end()) out.push_back(w);
}

bool MeshEdit::move(std::uint32_t v, const glm::dvec3& to) {
    gone_.assign(around_[v].begin(), around_[v].end());
    for (const std::uint32_t t : gone_) take(t);
    const glm::dvec3 from = at(v);
    mesh_.position_world[v] = to;
    bool met =
        std::any_of(gone_.begin(), gone_.end(), [&](std::uint32_t t) { return meets(mesh_.triangles[t]); });
    for (std::size_t n = 0; n < gone_.size() && !met; ++n)
        for (std::size_t m = 0; m < n && !met; ++m)
            met = trianglesMeet(mesh_.position_world, mesh_.triangles[gone_[n]], mesh_.triangles[gone_[m]]);
    if (met) mesh_.position_world[v] = from;
    for (const std::uint32_t t : gone_) put(t);
    return !met;
}

bool MeshEdit::divide(const Diamond& d, const glm::dvec3& place) {
    const auto v = static_cast<std::uint32_t>(mesh_.position_world.size());
    mesh_.position_world.push_back(place), around_.emplace_back();
    next_.clear();
    for (const std::uint32_t side : d.sides)
        for (const std::uint32_t end : {d.b, d.a}) {
            next_.push_back(mesh_.triangles[side]);
            std::replace(next_.back().begin(), next_.back().end(), end, v);
        }
    if (replace(d.sides, next_)) return true;
    mesh_.position_world.pop_back(), around_.pop_back();
    return false;
}

bool MeshEdit::turn(const Diamond& d) {
    const auto [p, q] = d.tips;
    if (isEdge(p, q)) return false;
    next_.assign({mesh_.triangles[d.sides[0]], mesh_.triangles[d.sides[1]]});
    std::replace(next_[0].begin(), next_[0].end(), d.b, q);
    std::replace(next_[1].begin(), next_[1].end(), d.a, p);
    return replace(d.sides, next_);
}

bool MeshEdit::collapse(std::uint32_t v, std::uint32_t u) {
    // The ends have two neighbours in common, no more: else the mesh would touch itself.
    std::vector<std::uint32_t> of_v, of_u;
    neighboursOf(v, of_v), neighboursOf(u, of_u);
    std::size_t common = 0;
    for (const std::uint32_t w : of_v) common += std::find(of_u.begin(), of_u.end(), w) != of_u.end();
    if (common != 2 || of_v.size() + of_u.size() <= 7) return false;
    gone_.assign(around_[v].begin(), around_[v].end());
    next_.clear();
    for (const std::uint32_t t : gone_) {
        if (holds(mesh_.triangles[t], u)) continue;
        next_.push_back(mesh_.triangles[t]);
        std::replace(next_.back().begin(), next_.back().end(), v, u);
    }
    return replace(gone_, next_);
}

void MeshEdit::compact() {
    std::erase_if(mesh_.triangles, [](const Triangle& t) { return t[0] == kGone; });
    std::uint32_t count = 0;
    std::vector<std::uint32_t> number(around_.size(), kGone);
    for (std::uint32_t v = 0; v < around_.size(); ++v)
        if (!around_[v].empty()) number[v] = count, mesh_.position_world[count++] = mesh_.position_world[v];
    mesh_.position_world.resize(count);
    for (Triangle& t : mesh_.triangles)
        for (std::uint32_t& v : t) v = number[v];
}

}  // namespace edgewise::sdf
