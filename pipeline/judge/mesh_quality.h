// What is known of a mesh: its topology, its shape, and how far it is from the surface that it stands for.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "sdf/mesh_lattice.h"
#include "sdf/most_off.h"
#include "sdf/point_field.h"
#include "sdf/surface_mesh.h"

namespace edgewise {

/// Largest distances that were found, of a number of places asked; `spacing`: no place of the mesh (of the
/// surface: of its part in a cell, on average) is further from one that was asked.
struct MeshDistance {
    double mesh_to_surface = 0.0, surface_to_mesh = 0.0;
    glm::dvec3 worst_on_surface{0.0};
    double worst_part = 0.0;  ///< the largest of all distances over what is allowed at their places
    std::size_t mesh_samples = 0, surface_samples = 0;
    double mesh_spacing = 0.0, surface_spacing = 0.0;
};

struct MeshQuality {
    std::size_t vertices = 0, triangles = 0, edges = 0;
    std::size_t border_edges = 0;       ///< of one triangle
    std::size_t nonmanifold_edges = 0;  ///< of more than two triangles, or of two that pass it the same way
    std::size_t nonmanifold_vertices = 0;  ///< whose triangles are no single fan
    std::size_t components = 0;
    std::int64_t euler = 0;  ///< vertices - edges + triangles
    double area = 0.0, volume = 0.0;
    double smallest_angle_degrees = 0.0;
    /// Pairs of triangles, by exact arithmetic; none in a build without CGAL, or where it was not asked for.
    std::optional<std::size_t> self_intersections;
    std::optional<MeshDistance> distance;

    bool closed() const { return border_edges == 0; }
    bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
};

/// All but self-intersections and distances.
MeshQuality qualityOf(const sdf::SurfaceMesh& mesh);

/// Pairs of triangles with a common point that is no common vertex or edge; none without CGAL.
std::optional<std::size_t> selfIntersections(const sdf::SurfaceMesh& mesh);

/// From places on the mesh to the surface: along the gradient to where the value is 0. From places on the
/// surface, found on random lines through the lattice's cells, to the mesh. `per_cell`: lines a cell. On
/// a triangle the least is allowed that is allowed within `mesh_spacing` of the place, its own.
/// None without CGAL.
std::optional<MeshDistance> distanceOf(const sdf::SurfaceMesh& mesh, const sdf::Tape& tape,
                                       const sdf::Lattice& lattice, bool bound_holds, int per_cell,
                                       const sdf::MostOff* allowed = nullptr);

/// The same of a field that is asked at many points at once: to what differences and its numbers' rounding
/// tell of it.
std::optional<MeshDistance> distanceOf(const sdf::SurfaceMesh& mesh, const sdf::PointField& field,
                                       const sdf::Lattice& lattice, int per_cell,
                                       const sdf::MostOff* allowed = nullptr);

/// As --stats and the command print it.
nlohmann::json jsonOf(const MeshQuality& quality);

}  // namespace edgewise
