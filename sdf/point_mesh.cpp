#include "sdf/point_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/point_dual.h"
#include "sdf/point_slopes.h"
#include "sdf/scene_error.h"
#include "sdf/unit_or.h"

namespace edgewise::sdf {
namespace {

/// How far from a corner to the centre its normal is asked for.
constexpr double kInward = 0.02;
/// Differences within so many reaches of a crease may see both of its sides.
constexpr double kClear = 2.0;
/// Of a slope's reach: what normals are asked over, nearer to creases, for eight times the rounding: in float
/// 2^-11, which light does not show.
constexpr double kLooksReach = 0.125;
/// Of the box's longest side: cubes are divided until they are as small, and while there are no more.
constexpr double kFineEnough = 1.0 / 64.0;
constexpr std::size_t kMostCubes = std::size_t(1) << 20;
constexpr double kSlack = 1e-3;

/// From a little inside the triangles, and so far that differences stay on one side of a crease; a triangle
/// that is too small for that has its own normal.
void findLooks(const PointField& field, double reach, SurfaceMesh& mesh) {
    mesh.material.assign(mesh.triangles.size(), 0);
    std::vector<glm::dvec3> places, normals;
    std::vector<bool> small;
    for (const Triangle& t : mesh.triangles) {
        glm::dvec3 centre(0.0);
        for (const std::uint32_t v : t) centre += mesh.position_world[v] / 3.0;
        for (const std::uint32_t v : t) {
            const glm::dvec3 way = centre - mesh.position_world[v];
            const double part = std::max(kInward, kClear * reach / std::max(glm::length(way), 1e-300));
            places.push_back(mesh.position_world[v] + std::min(part, 1.0) * way);
            small.push_back(part > 1.0);
        }
    }
    const std::vector<glm::dvec3> slopes = slopesAt(field, places, reach);
    for (const Triangle& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.position_world[t[0]], &b = mesh.position_world[t[1]],
                         &c = mesh.position_world[t[2]];
        const glm::dvec3 flat = unitOr(glm::cross(b - a, c - a), {0, 1, 0});
        std::array<glm::dvec3, 3> own;
        for (glm::dvec3& normal : own) {
            normal = unitOr(slopes[normals.size()], flat);
            if (small[normals.size()] || !(glm::dot(normal, flat) > 0.0)) normal = flat;
            normals.push_back(normal);
        }
        mesh.normal_world.push_back(own);
    }
    const std::vector<glm::dvec3> colors = field.colors(places, normals);
    for (std::size_t i = 0; i < colors.size(); i += 3)
        mesh.color.push_back({colors[i], colors[i + 1], colors[i + 2]});
}

struct Cubes {
    std::vector<glm::dvec3> centre;
    std::vector<double> value;
    double half = 0.0;

    Box box() const {
        Box box{{1, 1, 1}, {-1, -1, -1}};
        for (std::size_t i = 0; i < centre.size(); ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const double low = centre[i][axis] - half, high = centre[i][axis] + half;
                box.low[axis] = i == 0 ? low : std::min(box.low[axis], low);
                box.high[axis] = i == 0 ? high : std::max(box.high[axis], high);
            }
        return box;
    }
};

/// Cubes of half the side that something may be inside of.
Cubes divided(const PointField& field, const Cubes& cubes) {
    Cubes parts;
    parts.half = 0.5 * cubes.half;
    std::vector<double> around;
    for (std::size_t i = 0; i < cubes.centre.size(); ++i)
        for (int n = 0; n < 8; ++n) {
            parts.centre.push_back(cubes.centre[i] +
                                   parts.half * glm::dvec3(n & 1 ? 1 : -1, n & 2 ? 1 : -1, n & 4 ? 1 : -1));
            around.push_back(cubes.value[i]);
        }
    parts.value = field.values(parts.centre);
    const double most = field.lipschitz() * (1.0 + kSlack) * std::sqrt(3.0) * parts.half;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < parts.centre.size(); ++i) {
        if (!(std::abs(parts.value[i] - around[i]) <= most))
            throw SceneError("map",
                             "values change faster than its `lipschitz` says, so that nobody knows "
                             "where it ends: a mesh of it needs --box X0,Y0,Z0,X1,Y1,Z1");
        if (parts.value[i] > most) continue;
        parts.centre[kept] = parts.centre[i], parts.value[kept++] = parts.value[i];
    }
    parts.centre.resize(kept), parts.value.resize(kept);
    return parts;
}

}  // namespace

SurfaceMesh meshOfPoints(const PointMeshRequest& request, MeshCounts& counts, bool& bound_holds) {
    const PointBricks bricks(request.field, request.lattice, request.between);
    bound_holds = bricks.boundHolds();
    counts.nodes = bricks.list().nodes, counts.pruned = bricks.list().pruned;
    counts.bricks = bricks.list().bricks.size();
    if (bricks.list().open)
        throw SceneError("surface", "it reaches the end of the box: the mesh would be open");
    SurfaceMesh mesh = request.dual ? dualOfPoints(request.field, request.lattice, bricks, counts.cells)
                                    : marchBricks(request.lattice, bricks.list(), bricks, counts);
    if (request.between) request.between();
    findLooks(request.field, kLooksReach * slopeReach(request.field, request.lattice), mesh);
    return mesh;
}

std::optional<Box> boxOfPoints(const PointField& field, double half) {
    Cubes cubes{{glm::dvec3(0.0)}, {}, half};
    cubes.value = field.values(cubes.centre);
    for (;;) {
        cubes = divided(field, cubes);
        const Box box = cubes.box();
        if (cubes.centre.empty()) return box;
        double longest = 0.0;
        bool reaches = false;
        for (int axis = 0; axis < 3; ++axis) {
            longest = std::max(longest, box.high[axis] - box.low[axis]);
            reaches |= box.low[axis] <= -half || box.high[axis] >= half;
        }
        const bool fine = 2.0 * cubes.half <= kFineEnough * longest;
        if (!fine && cubes.centre.size() <= kMostCubes) continue;
        return reaches ? std::nullopt : std::optional(box);
    }
}

}  // namespace edgewise::sdf
