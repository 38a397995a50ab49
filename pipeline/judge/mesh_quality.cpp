#include "pipeline/judge/mesh_quality.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <numeric>

namespace edgewise {
namespace {

using sdf::SurfaceMesh, sdf::Triangle;

/// Each triangle's sides by their ends, the lower one first.
struct Side {
    std::uint32_t low, high, triangle;
    bool up;  ///< the triangle passes it from low to high
};

std::vector<Side> sortedSides(const SurfaceMesh& mesh) {
    std::vector<Side> sides;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return sides;
}

class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t of(std::uint32_t x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[of(a)] = of(b); }

  private:
    std::vector<std::uint32_t> parent_;
};

void countEdges(const std::vector<Side>& sides, MeshQuality& quality) {
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i, up = 0;
        while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
            up += sides[end++].up;
        ++quality.edges;
        if (end - i == 1) ++quality.border_edges;
        if (end - i > 2 || (end - i == 2 && up != 1)) ++quality.nonmanifold_edges;
        i = end;
    }
}

/// Corners of triangles joined over sides: a vertex with more than one set of corners is no single fan.
void countVertices(const SurfaceMesh& mesh, const std::vector<Side>& sides, MeshQuality& quality) {
    const auto cornerOf = [&](std::uint32_t triangle, std::uint32_t vertex) {
        const Triangle& t = mesh.triangles[triangle];
        return 3 * triangle + (t[0] == vertex ? 0u : t[1] == vertex ? 1u : 2u);
    };
    Sets corners(3 * mesh.triangles.size()), parts(mesh.position_world.size());
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i].low != sides[i - 1].low || sides[i].high != sides[i - 1].high) continue;
        for (const std::uint32_t v : {sides[i].low, sides[i].high})
            corners.join(cornerOf(sides[i].triangle, v), cornerOf(sides[i - 1].triangle, v));
    }
    std::vector<std::uint32_t> fans(mesh.position_world.size(), 0);
    for (std::uint32_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
        const Triangle& t = mesh.triangles[c / 3];
        fans[t[c % 3]] += corners.of(c) == c;
        parts.join(t[0], t[c % 3]);
    }
    for (std::uint32_t v = 0; v < fans.size(); ++v) {
        quality.vertices += fans[v] > 0;
        quality.nonmanifold_vertices += fans[v] > 1;
        quality.components += fans[v] > 0 && parts.of(v) == v;
    }
}

double angleAt(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return std::atan2(glm::length(glm::cross(b - a, c - a)), glm::dot(b - a, c - a));
}

void measureShape(const SurfaceMesh& mesh, MeshQuality& quality) {
    double smallest = glm::pi<double>();
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.position_world[t[0]], &b = mesh.position_world[t[1]],
                         &c = mesh.position_world[t[2]];
        quality.area += 0.5 * glm::length(glm::cross(b - a, c - a));
        quality.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
        smallest = std::min({smallest, angleAt(a, b, c), angleAt(b, c, a), angleAt(c, a, b)});
    }
    quality.smallest_angle_degrees = mesh.triangles.empty() ? 0.0 : smallest * 180.0 / glm::pi<double>();
}

}  // namespace

MeshQuality qualityOf(const SurfaceMesh& mesh) {
    MeshQuality quality;
    quality.triangles = mesh.triangles.size();
    const std::vector<Side> sides = sortedSides(mesh);
    countEdges(sides, quality);
    countVertices(mesh, sides, quality);
    measureShape(mesh, quality);
    quality.euler = static_cast<std::int64_t>(quality.vertices) - static_cast<std::int64_t>(quality.edges) +
                    static_cast<std::int64_t>(quality.triangles);
    return quality;
}

nlohmann::json jsonOf(const MeshQuality& quality) {
    nlohmann::json json{{"triangles", quality.triangles},
                        {"vertices", quality.vertices},
                        {"border_edges", quality.border_edges},
                        {"nonmanifold_edges", quality.nonmanifold_edges},
                        {"nonmanifold_vertices", quality.nonmanifold_vertices},
                        {"edge_manifold", quality.nonmanifold_edges == 0},
                        {"closed", quality.closed()},
                        {"components", quality.components},
                        {"euler", quality.euler},
                        {"area", quality.area},
                        {"volume", quality.volume},
                        {"smallest_angle_degrees", quality.smallest_angle_degrees},
                        {"self_intersections", nullptr},
                        {"distance", nullptr}};
    if (quality.self_intersections) json["self_intersections"] = *quality.self_intersections;
    if (const auto& d = quality.distance)
        json["distance"] = {
            {"mesh_to_surface", d->mesh_to_surface},
            {"surface_to_mesh", d->surface_to_mesh},
            {"mesh_samples", d->mesh_samples},
            {"surface_samples", d->surface_samples},
            {"mesh_spacing", d->mesh_spacing},
            {"surface_spacing", d->surface_spacing},
            {"worst_on_surface", {d->worst_on_surface.x, d->worst_on_surface.y, d->worst_on_surface.z}},
            {"bound", "the largest of the samples; between them at most the spacing more"}};
    return json;
}

}  // namespace edgewise
