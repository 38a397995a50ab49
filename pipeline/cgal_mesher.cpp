#include "pipeline/cgal_mesher.h"

#include "pipeline/error.h"

#ifdef EDGEWISE_HAS_ORACLE
#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/make_surface_mesh.h>
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <map>

#include "sdf/dual_cells.h"
#include "sdf/evaluate.h"
#include "sdf/mesh_attributes.h"
#endif

namespace edgewise {

#ifdef EDGEWISE_HAS_ORACLE
namespace {

using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Complex = CGAL::Complex_2_in_triangulation_3<Triangulation>;
using Kernel = Triangulation::Geom_traits;
using Point = Kernel::Point_3;

constexpr double kLeastDegrees = 30.0;
/// Of a cell's side: circumscribed circles, and from their centres to the surface.
constexpr double kRadius = 0.7, kOff = 0.1;
/// Of a cell's side: how well the surface is found along a segment.
constexpr double kPrecision = 1e-9;
/// One crossing in so many is a point at first: every part of the surface has some.
constexpr std::size_t kSeedsOneIn = 16;
/// Values asked for, a crossing of cells' edges: far more than smooth surfaces take (some hundreds).
constexpr std::uint64_t kMostValues = 20000;

Point pointOf(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}
glm::dvec3 placeOf(const Point& p) {
    return {p.x(), p.y(), p.z()};
}

void requireSmooth(const sdf::DualComplex& complex, const std::string& source) {
    for (const sdf::DualVertex& v : complex.vertices)
        if (v.rank > 1)
            throw InputError(source, fmt::format("its surface has a sharp edge near {:.4g},{:.4g},{:.4g}: "
                                                 "--mesher cgal is for smooth ones",
                                                 v.target_world.x, v.target_world.y, v.target_world.z));
}

/// A ball around the lattice whose centre is inside the solid.
Kernel::Sphere_3 ballAround(const sdf::Lattice& lattice, const sdf::DualPolygon& inwardFrom) {
    const glm::dvec3 centre = inwardFrom.crossing.point - 1e-3 * lattice.step * inwardFrom.crossing.normal;
    const double reach = glm::length(lattice.step * glm::dvec3(lattice.cells));
    return {pointOf(centre), reach * reach};
}

sdf::SurfaceMesh meshOf(const Complex& complex, const sdf::TapeAt& tape) {
    sdf::SurfaceMesh mesh;
    std::map<Complex::Vertex_handle, std::uint32_t> number;
    for (auto facet = complex.facets_begin(); facet != complex.facets_end(); ++facet) {
        sdf::Triangle t;
        for (int i = 0; i < 3; ++i) {
            const auto vertex = facet->first->vertex(Triangulation::vertex_triple_index(facet->second, i));
            const auto at =
                number.try_emplace(vertex, static_cast<std::uint32_t>(mesh.position_world.size()));
            if (at.second) mesh.position_world.push_back(placeOf(vertex->point()));
            t[static_cast<std::size_t>(i)] = at.first->second;
        }
        const auto& x = mesh.position_world;
        const glm::dvec3 centre = (x[t[0]] + x[t[1]] + x[t[2]]) / 3.0;
        const glm::dvec3 outward = sdf::gradientAt(tape(centre), centre).gradient;
        if (glm::dot(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]), outward) < 0.0) std::swap(t[1], t[2]);
        mesh.triangles.push_back(t);
    }
    return mesh;
}

}  // namespace

sdf::SurfaceMesh cgalMesh(const sdf::MeshRequest& request, const std::string& source,
                          sdf::MeshCounts& counts) {
    const sdf::DualComplex cells = sdf::dualComplex(request);
    counts.nodes = cells.bricks.nodes, counts.pruned = cells.bricks.pruned;
    counts.bricks = cells.bricks.bricks.size(), counts.cells = cells.cells;
    requireSmooth(cells, source);
    if (cells.polygons.empty()) return {};
    const sdf::Lattice& lattice = request.lattice;
    const sdf::TapeAt tape(request.tape, lattice, request.bound_holds);
    std::uint64_t left = kMostValues * cells.polygons.size();
    const auto value = [&](const Point& p) {
        if (left-- == 0)
            throw FailureError("--mesher cgal", "it does not end on " + source + ": is its field smooth?");
        const glm::dvec3 at = placeOf(p);
        return sdf::valueAt(tape(at), at);
    };
    Triangulation triangulation;
    for (std::size_t n = 0; n < cells.polygons.size(); n += kSeedsOneIn)
        triangulation.insert(pointOf(cells.polygons[n].crossing.point));
    Complex complex(triangulation);
    const Kernel::Sphere_3 ball = ballAround(lattice, cells.polygons.front());
    const CGAL::Implicit_surface_3<Kernel, decltype(value)> surface(
        value, ball, kPrecision * lattice.step / std::sqrt(CGAL::to_double(ball.squared_radius())));
    const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(kLeastDegrees, kRadius * lattice.step,
                                                                        kOff * lattice.step);
    CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag(), 0);
    sdf::SurfaceMesh mesh = meshOf(complex, tape);
    sdf::findMaterials(tape, mesh);
    if (request.attributes) sdf::findNormals(tape, mesh);
    return mesh;
}
#else
sdf::SurfaceMesh cgalMesh(const sdf::MeshRequest&, const std::string&, sdf::MeshCounts&) {
    throw FailureError("--mesher cgal", "this build has no CGAL");
}
#endif

}  // namespace edgewise
