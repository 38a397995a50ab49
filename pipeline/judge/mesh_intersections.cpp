// CGAL: exact predicates and a tree of boxes.
#include "pipeline/judge/mesh_quality.h"

#ifdef EDGEWISE_HAS_ORACLE
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#endif

namespace edgewise {

#ifdef EDGEWISE_HAS_ORACLE
std::optional<std::size_t> selfIntersections(const sdf::SurfaceMesh& mesh) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Faces = CGAL::Surface_mesh<Kernel::Point_3>;
    Faces faces;
    std::vector<Faces::Vertex_index> vertices;
    for (const glm::dvec3& p : mesh.position_world) vertices.push_back(faces.add_vertex({p.x, p.y, p.z}));
    for (const sdf::Triangle& t : mesh.triangles)
        if (faces.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) == Faces::null_face())
            return std::nullopt;  // not manifold: CGAL's mesh cannot hold it
    std::vector<std::pair<Faces::Face_index, Faces::Face_index>> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(faces, std::back_inserter(pairs));
    return pairs.size();
}
#else
std::optional<std::size_t> selfIntersections(const sdf::SurfaceMesh&) {
    return std::nullopt;
}
#endif

}  // namespace edgewise
