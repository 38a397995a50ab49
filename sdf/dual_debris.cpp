#include "sdf/dual_debris.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "sdf/inward_way.h"

namespace edgewise::sdf {
namespace {

constexpr int kMostSteps = 400;

/// By their vertices.
std::vector<std::uint32_t> surfacesOf(const DualComplex& complex) {
    std::vector<std::uint32_t> parent(complex.vertices.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto rootOf = [&](std::uint32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const DualPolygon& polygon : complex.polygons)
        for (const std::uint32_t v : polygon.vertex) parent[rootOf(v)] = rootOf(polygon.vertex[0]);
    for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = rootOf(v);
    return parent;
}

class Surface {
  public:
    Surface(const MeshRequest& request, const TapeAt& tape, const DualComplex& complex,
            std::vector<std::uint32_t> polygons)
        : request_(request), tape_(tape), complex_(complex), polygons_(std::move(polygons)) {}

    bool isDebris() const {
        const bool solid = volume() > 0.0;
        const DualPolygon& polygon = complex_.polygons[polygons_.front()];
        return leadsOut(endOf(polygon, solid), solid);
    }

  private:
    double volume() const {
        double six = 0.0;
        for (const std::uint32_t p : polygons_) {
            const DualPolygon& polygon = complex_.polygons[p];
            const auto at = [&](int k) { return complex_.vertices[polygon.vertex[k]].middle_world; };
            const double both = glm::dot(at(0), glm::cross(at(1), at(2)) + glm::cross(at(2), at(3)));
            six += polygon.outward ? both : -both;
        }
        return six;
    }
    /// The edge's end in the solid, or the one outside.
    glm::dvec3 endOf(const DualPolygon& polygon, bool inside) const {
        glm::ivec3 corner = polygon.corner;
        if (polygon.outward != inside) corner[polygon.axis] += kUnits >> polygon.level;
        return request_.lattice.corner(corner);
    }

    /// The way comes so near to a corner that this is on its side too, and the corner is not within.
    bool leadsOut(const glm::dvec3& from, bool solid) const {
        const Lattice& lattice = request_.lattice;
        InwardWay way(tape_, request_.tape.lipschitz, from, solid);
        glm::ivec3 last(-1);
        for (int n = 0; n < kMostSteps && way.isOn(); ++n, way.step()) {
            const glm::ivec3 corner =
                kUnits * glm::ivec3(glm::round((way.place() - lattice.low_world) / lattice.step));
            if (corner == last || glm::distance(lattice.corner(corner), way.place()) >= way.reach()) continue;
            if (!isAround(corner)) return true;
            last = corner;
        }
        return false;
    }

    /// Along the lattice's line from a corner of undivided cells, the surface is crossed an odd number of
    /// times.
    bool isAround(const glm::ivec3& corner) const {
        bool odd = false;
        for (const std::uint32_t p : polygons_) {
            const DualPolygon& polygon = complex_.polygons[p];
            odd ^= polygon.axis == 0 && polygon.corner.y == corner.y && polygon.corner.z == corner.z &&
                   polygon.corner.x >= corner.x;
        }
        return odd;
    }

    const MeshRequest& request_;
    const TapeAt& tape_;
    const DualComplex& complex_;
    const std::vector<std::uint32_t> polygons_;
};

void leaveOut(const std::vector<bool>& goes, DualComplex& complex) {
    std::vector<std::uint32_t> vertex_number(complex.vertices.size(), kNoVertex),
        polygon_number(complex.polygons.size(), kNoVertex);
    std::uint32_t vertices = 0, polygons = 0;
    const auto setPassed = [&](const DualVertex& v, bool passed) {
        const glm::ivec3 place = (v.cell.low - complex.bricks.bricks[v.brick].first) / v.cell.side;
        complex.passed[v.brick].set(
            static_cast<std::size_t>(place.x + kBrickCells * (place.y + kBrickCells * place.z)), passed);
    };
    for (std::size_t v = 0; v < goes.size(); ++v)
        if (goes[v]) setPassed(complex.vertices[v], false);
    for (std::uint32_t p = 0; p < polygon_number.size(); ++p)
        if (!goes[complex.polygons[p].vertex[0]]) polygon_number[p] = polygons++;
    for (std::uint32_t v = 0; v < goes.size(); ++v) {
        if (goes[v]) continue;
        setPassed(complex.vertices[v], true);
        complex.vertices[vertices] = complex.vertices[v], vertex_number[v] = vertices++;
    }
    for (std::uint32_t p = 0; p < polygon_number.size(); ++p) {
        if (polygon_number[p] == kNoVertex) continue;
        DualPolygon polygon = complex.polygons[p];
        for (std::uint32_t& v : polygon.vertex) v = vertex_number[v];
        for (std::uint32_t& q : polygon.across)
            if (q != kNoVertex) q = polygon_number[q];
        complex.polygons[polygon_number[p]] = polygon;
    }
    complex.vertices.resize(vertices), complex.polygons.resize(polygons);
}

}  // namespace

std::size_t leaveOutDebris(const MeshRequest& request, const TapeAt& tape, DualComplex& complex) {
    if (!request.bound_holds || complex.polygons.empty()) return 0;
    const std::vector<std::uint32_t> surface_of = surfacesOf(complex);
    std::vector<std::vector<std::uint32_t>> polygons_of(complex.vertices.size());
    for (std::uint32_t p = 0; p < complex.polygons.size(); ++p)
        polygons_of[surface_of[complex.polygons[p].vertex[0]]].push_back(p);
    std::vector<bool> debris(complex.vertices.size(), false);
    std::size_t count = 0;
    for (std::uint32_t s = 0; s < polygons_of.size(); ++s)
        if (!polygons_of[s].empty() && Surface(request, tape, complex, std::move(polygons_of[s])).isDebris())
            debris[s] = true, ++count;
    if (count == 0) return 0;
    std::vector<bool> goes(complex.vertices.size());
    for (std::size_t v = 0; v < goes.size(); ++v) goes[v] = debris[surface_of[v]];
    leaveOut(goes, complex);
    return count;
}

}  // namespace edgewise::sdf
