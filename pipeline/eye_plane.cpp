#include "pipeline/eye_plane.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace edgewise {
namespace {

using f64::dd;
using DdVector = std::array<dd, 3>;
using DdMatrix = std::array<DdVector, 3>;  // rows

DdVector widen(const glm::dvec3& v) {
    return {f64::ddFrom(v.x), f64::ddFrom(v.y), f64::ddFrom(v.z)};
}

dd dot(const DdVector& a, const DdVector& b) {
    return f64::ddAdd(f64::ddAdd(f64::ddMul(a[0], b[0]), f64::ddMul(a[1], b[1])), f64::ddMul(a[2], b[2]));
}

DdVector cross(const DdVector& a, const DdVector& b) {
    auto minor = [&](int i, int j) { return f64::ddSub(f64::ddMul(a[i], b[j]), f64::ddMul(a[j], b[i])); };
    return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

DdVector difference(const DdVector& a, const DdVector& b) {
    return {f64::ddSub(a[0], b[0]), f64::ddSub(a[1], b[1]), f64::ddSub(a[2], b[2])};
}

DdVector multiply(const DdMatrix& m, const DdVector& v) {
    return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

DdMatrix linearPart(const glm::dmat4& m) {
    DdMatrix rows;
    for (int row = 0; row < 3; ++row) rows[row] = widen({m[0][row], m[1][row], m[2][row]});
    return rows;
}

/// cof(M) (a x b) = (M a) x (M b), also where M is singular or mirrors.
DdMatrix cofactor(const DdMatrix& m) {
    return {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
}

DdVector transform(const glm::dmat4& m, const DdVector& p) {
    DdVector moved = multiply(linearPart(m), p);
    for (int row = 0; row < 3; ++row) moved[row] = f64::ddAdd(moved[row], f64::ddFrom(m[3][row]));
    return moved;
}

/// Of each geometry that has an affine map from the file.
std::vector<DdMatrix> fileCofactors(const Scene& scene) {
    std::vector<DdMatrix> all(scene.geometry.size());
    for (std::size_t g = 0; g < all.size(); ++g)
        if (const auto& map = scene.geometry[g].world_from_file) all[g] = cofactor(linearPart(*map));
    return all;
}

/// The plane in the world: through the node's affine map from the file, or through the world's own vertices.
EyePlane worldPlane(const Geometry& geometry, const DdMatrix& cofactors, const FilePlane& plane) {
    const auto& corner = geometry.triangles[plane.triangle];
    EyePlane world;
    DdVector point;
    if (geometry.world_from_file) {
        world.n = multiply(cofactors, plane.normal);
        point = transform(*geometry.world_from_file, widen(glm::dvec3(geometry.position_file[corner[0]])));
    } else {
        point = widen(geometry.position_world[corner[0]]);
        world.n = cross(difference(widen(geometry.position_world[corner[1]]), point),
                        difference(widen(geometry.position_world[corner[2]]), point));
    }
    world.d = dot(world.n, point);
    return world;
}

/// n' = cof(C) n, and for a point q of the plane d' = n' . (C q + c) = det(C) d + n' . c.
struct CameraPlaneMap {
    DdMatrix cofactors;
    dd determinant;
    DdVector translation;

    explicit CameraPlaneMap(const glm::dmat4& camera_from_world)
        : cofactors(cofactor(linearPart(camera_from_world))),
          determinant(dot(linearPart(camera_from_world)[0], cofactors[0])),
          translation(widen(glm::dvec3(camera_from_world[3]))) {}

    EyePlane apply(const EyePlane& world) const {
        EyePlane eye;
        eye.n = multiply(cofactors, world.n);
        eye.d = f64::ddAdd(f64::ddMul(determinant, world.d), dot(eye.n, translation));
        return eye;
    }
};

bool usable(const DepthPlane& plane) {
    constexpr double kLargest = 0x1p900;  // error-free products need room below overflow
    return std::fabs(plane.dz_dx) < kLargest && std::fabs(plane.dz_dy) < kLargest &&
           std::fabs(plane.z_anchor) < kLargest;
}

/// (a x + b y + c) scale, all double-double.
dd affine(const dd& a, double x, const dd& b, double y, const dd& c, double scale) {
    return f64::ddAdd(f64::ddAdd(f64::ddMulReal(a, x), f64::ddMulReal(b, y)), f64::ddMulReal(c, scale));
}

}  // namespace

glm::dvec3 EyePlane::unitNormal(bool perspective) const {
    glm::dvec3 normal(n[0].hi, n[1].hi, n[2].hi);
    const double size = std::max({std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)});
    if (size == 0.0) return {0.0, 0.0, 1.0};
    normal /= size;
    return normal * ((facing(perspective) < 0.0 ? -1.0 : 1.0) / std::sqrt(glm::dot(normal, normal)));
}

std::vector<EyePlane> makeEyePlanes(const Scene& scene, const CoplanarGroups& groups,
                                    const glm::dmat4& camera_from_world) {
    const CameraPlaneMap to_eye(camera_from_world);
    const std::vector<DdMatrix> cofactors = fileCofactors(scene);
    std::vector<EyePlane> planes(groups.planes.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, planes.size(), 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const FilePlane& file = groups.planes[i];
            planes[i] =
                to_eye.apply(worldPlane(scene.geometry[file.geometry], cofactors[file.geometry], file));
        }
    });
    return planes;
}

std::optional<DepthPlane> depthPlane(const EyePlane& plane, const ScreenMap& map) {
    const auto& [nx, ny, nz] = plane.n;
    const dd ny_down = f64::ddNeg(ny);  // the screen's y points down
    const glm::dvec2 from_principal = ((map.anchorPx() - map.offset_px) - map.whole_px) - map.fraction_px;
    const dd divisor = map.perspective ? plane.d : f64::ddNeg(nz);
    if (divisor.hi == 0.0) return std::nullopt;
    const dd per_px = f64::ddMulReal(divisor, map.scale_px);
    const dd constant = f64::ddNeg(map.perspective ? nz : plane.d);
    const dd at_anchor = affine(nx, from_principal.x, ny_down, from_principal.y, constant, map.scale_px);
    const DepthPlane depth{f64::ddDiv(nx, per_px).hi, f64::ddDiv(ny_down, per_px).hi,
                           f64::ddDiv(at_anchor, per_px).hi};
    if (!usable(depth)) return std::nullopt;
    return depth;
}

}  // namespace edgewise
