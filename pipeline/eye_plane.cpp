#include "pipeline/eye_plane.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "analytic/instruction_set.h"

namespace edgewise {

#define EDGEWISE_DECLARE_PLANES(isa)                                             \
    namespace isa {                                                              \
    void eyePlanes(const WorldMap*, const EyeMap&, const PlanesIn&, PlanesOut&); \
    }
EDGEWISE_DECLARE_PLANES(scalar)
EDGEWISE_DECLARE_PLANES(sse2)
#if defined(EDGEWISE_HAS_AVX)
EDGEWISE_DECLARE_PLANES(avx2)
EDGEWISE_DECLARE_PLANES(avx512)
#endif

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

DdVector difference(const glm::dvec3& a, const glm::dvec3& b) {
    return {f64::twoSum(a.x, -b.x), f64::twoSum(a.y, -b.y), f64::twoSum(a.z, -b.z)};
}

DdMatrix linearPart(const glm::dmat4& m) {
    DdMatrix rows;
    for (int row = 0; row < 3; ++row) rows[row] = widen({m[0][row], m[1][row], m[2][row]});
    return rows;
}

DdMatrix cofactor(const DdMatrix& m) {
    return {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
}

LaneMatrix lanes(const DdMatrix& m) {
    LaneMatrix out;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) out.hi[i][j] = m[i][j].hi, out.lo[i][j] = m[i][j].lo;
    return out;
}

EyeMap eyeMap(const glm::dmat4& camera_from_world, const ScreenMap& map) {
    const DdMatrix linear = linearPart(camera_from_world), cofactors = cofactor(linear);
    const dd determinant = dot(linear[0], cofactors[0]);
    const glm::dvec3 c(camera_from_world[3]);
    const glm::dvec2 from_principal = ((map.anchorPx() - map.offset_px) - map.whole_px) - map.fraction_px;
    return {lanes(cofactors),
            determinant.hi,
            determinant.lo,
            {c.x, c.y, c.z},
            map.perspective,
            map.scale_px,
            {from_principal.x, from_principal.y}};
}

/// None for the identity too: the file's planes are the world's.
std::optional<WorldMap> worldMap(const Geometry& geometry) {
    const auto& m = geometry.world_from_file;
    if (!m || *m == glm::dmat4(1.0)) return std::nullopt;
    WorldMap map{lanes(cofactor(linearPart(*m))), {}, {}};
    for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 3; ++k) map.linear[row][k] = (*m)[k][row];
        map.translation[row] = (*m)[3][row];
    }
    return map;
}

bool usable(const DepthPlane& plane) {
    constexpr double kLargest = 0x1p900;  // error-free products need room below overflow
    return std::fabs(plane.dz_dx) < kLargest && std::fabs(plane.dz_dy) < kLargest &&
           std::fabs(plane.z_anchor) < kLargest;
}

glm::dvec3 unitNormal(glm::dvec3 normal, double facing) {
    const double size = std::max({std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)});
    if (size == 0.0) return {0.0, 0.0, 1.0};
    normal /= size;
    return normal * ((facing < 0.0 ? -1.0 : 1.0) / std::sqrt(glm::dot(normal, normal)));
}

}  // namespace

EyePlanesFunction eyePlanesFor(const char* instruction_set) {
    if (!machineRuns(instruction_set)) return nullptr;
    const auto is = [=](const char* name) { return std::strcmp(instruction_set, name) == 0; };
    if (is("scalar")) return scalar::eyePlanes;
    if (is("sse2")) return sse2::eyePlanes;
#if defined(EDGEWISE_HAS_AVX)
    if (is("avx2")) return avx2::eyePlanes;
    if (is("avx512")) return avx512::eyePlanes;
#endif
    return nullptr;
}

EyePlanes::EyePlanes(const Scene& scene, const glm::dmat4& camera_from_world, const ScreenMap& map)
    : scene_(scene), eye_(eyeMap(camera_from_world, map)), planes_(bestForm(eyePlanesFor)) {
    for (const Geometry& geometry : scene.geometry) world_.push_back(worldMap(geometry));
}

/// From the file where an affine map leads from there, else through the world's own vertices.
void EyePlanes::load(const FilePlane& plane, int lane, PlanesIn& in) const {
    const Geometry& geometry = scene_.geometry[plane.geometry];
    const auto& corner = geometry.triangles[plane.triangle];
    const bool from_file = geometry.world_from_file.has_value();
    const auto& world = geometry.position_world;
    const glm::dvec3 a = from_file ? glm::dvec3(geometry.position_file[corner[0]]) : world[corner[0]];
    const DdVector normal = from_file
                                ? fileNormal(geometry, plane.triangle)
                                : cross(difference(world[corner[1]], a), difference(world[corner[2]], a));
    for (int axis = 0; axis < 3; ++axis) {
        in.normal_hi[axis][lane] = normal[axis].hi, in.normal_lo[axis][lane] = normal[axis].lo;
        in.point[axis][lane] = a[axis];
    }
}

EyePlane EyePlanes::finished(const PlanesOut& out, int lane) const {
    const glm::dvec3 n(out.normal[0][lane], out.normal[1][lane], out.normal[2][lane]);
    EyePlane plane;
    plane.facing = eye_.perspective ? -out.d[lane] : n.z;
    plane.normal = unitNormal(n, plane.facing);
    const DepthPlane depth{out.dz_dx[lane], out.dz_dy[lane], out.z_anchor[lane]};
    if (plane.facing != 0.0 && usable(depth)) plane.depth = depth;
    return plane;
}

/// Up to kPlaneLanes planes of one geometry.
void EyePlanes::make(std::span<const FilePlane> planes, PlanesOut& out) const {
    PlanesIn in{};
    for (std::size_t i = 0; i < planes.size(); ++i) load(planes[i], static_cast<int>(i), in);
    const auto& world = world_[planes[0].geometry];
    planes_(world ? &*world : nullptr, eye_, in, out);
}

EyePlane EyePlanes::of(const FilePlane& plane) const {
    PlanesOut out;
    make(std::span(&plane, 1), out);
    return finished(out, 0);
}

void EyePlanes::fill(std::span<const FilePlane> planes, std::vector<DepthPlane>& depths,
                     std::vector<glm::dvec3>& normals) const {
    depths.resize(planes.size()), normals.resize(planes.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, planes.size(), 1024), [&](const auto& range) {
        PlanesOut out;
        for (std::size_t begin = range.begin(), end; begin < range.end(); begin = end) {
            end = begin + 1;
            while (end < range.end() && end - begin < kPlaneLanes &&
                   planes[end].geometry == planes[begin].geometry)
                ++end;
            make(planes.subspan(begin, end - begin), out);
            for (std::size_t i = begin; i < end; ++i) {
                const EyePlane plane = finished(out, static_cast<int>(i - begin));
                depths[i] = plane.depth.value(), normals[i] = plane.normal;
            }
        }
    });
}

}  // namespace edgewise
