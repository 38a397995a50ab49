// SurfaceFunctions for one instruction set: define EDGEWISE_ISA (a namespace) and EDGEWISE_LANES (1, 2, 4 or 8), then
// include. Nothing here may call an inline function of another namespace: it could be linked into code for an older
// machine.
#include "analytic/shared_text.h"
#include "pipeline/surface_lanes.h"

#if defined(__x86_64__) && EDGEWISE_LANES > 1
#include <immintrin.h>
#define EDGEWISE_X86
#endif

namespace edgewise::surface_lanes::EDGEWISE_ISA {
namespace {
#include "analytic/real_lanes.h"

/// Vectors of reals as GLSL and glm have them.
struct dvec4 {
    real x, y, z, w;
};
struct dvec3 {
    real x, y, z;
    dvec3() = default;
    EDGEWISE_FN dvec3(real a, real b, real c) : x(a), y(b), z(c) {}
    EDGEWISE_FN explicit dvec3(real a) : x(a), y(a), z(a) {}
#if EDGEWISE_LANES > 1
    EDGEWISE_FN explicit dvec3(double a) : dvec3(splat(a)) {}
#endif
};
struct dvec2 {
    real x, y;
    dvec2() = default;
    EDGEWISE_FN dvec2(real a, real b) : x(a), y(b) {}
    EDGEWISE_FN explicit dvec2(const dvec3& a) : x(a.x), y(a.y) {}
#if EDGEWISE_LANES > 1
    EDGEWISE_FN explicit dvec2(double a) : x(splat(a)), y(splat(a)) {}
#else
    EDGEWISE_FN explicit dvec2(real a) : x(a), y(a) {}
#endif
};

#define EDGEWISE_BY_COMPONENT(op)                                                                                    \
    EDGEWISE_FN dvec2 operator op(const dvec2& a, const dvec2& b) { return {a.x op b.x, a.y op b.y}; }               \
    EDGEWISE_FN dvec3 operator op(const dvec3& a, const dvec3& b) { return {a.x op b.x, a.y op b.y, a.z op b.z}; }   \
    EDGEWISE_FN dvec4 operator op(const dvec4& a, const dvec4& b) {                                                  \
        return {a.x op b.x, a.y op b.y, a.z op b.z, a.w op b.w};                                                     \
    }
EDGEWISE_BY_COMPONENT(+)
EDGEWISE_BY_COMPONENT(-)
#undef EDGEWISE_BY_COMPONENT
EDGEWISE_FN dvec2 operator*(const dvec2& a, real b) { return {a.x * b, a.y * b}; }
EDGEWISE_FN dvec3 operator*(const dvec3& a, real b) { return {a.x * b, a.y * b, a.z * b}; }
EDGEWISE_FN dvec4 operator*(const dvec4& a, real b) { return {a.x * b, a.y * b, a.z * b, a.w * b}; }
EDGEWISE_FN dvec2 operator*(real a, const dvec2& b) { return {a * b.x, a * b.y}; }
EDGEWISE_FN dvec3 operator*(real a, const dvec3& b) { return {a * b.x, a * b.y, a * b.z}; }
EDGEWISE_FN dvec3 operator/(const dvec3& a, real b) { return {a.x / b, a.y / b, a.z / b}; }
EDGEWISE_FN dvec3 operator-(const dvec3& a) { return {-a.x, -a.y, -a.z}; }

#include "shaders/shared/double_double.glsl"
#include "shaders/shared/transcendental.glsl"
#include "shaders/shared/vectors.glsl"
#include "shaders/shared/surface_point.glsl"
#include "shaders/shared/brdf.glsl"

EDGEWISE_FN dvec2 splat2(const double* v) { return {splat(v[0]), splat(v[1])}; }
EDGEWISE_FN dvec3 splat3(const double* v) { return {splat(v[0]), splat(v[1]), splat(v[2])}; }
EDGEWISE_FN real load(const double* from) {
    real value;
    __builtin_memcpy(&value, from, sizeof value);
    return value;
}
using Lanes = double[SurfaceLanes::kLength];
EDGEWISE_FN dvec2 load2(const Lanes* v, int first) { return {load(v[0] + first), load(v[1] + first)}; }
EDGEWISE_FN dvec3 load3(const Lanes* v, int first) {
    return {load(v[0] + first), load(v[1] + first), load(v[2] + first)};
}
EDGEWISE_FN void store(const dvec3& value, int first, double (*out)[kSurfaceLanes]) {
    __builtin_memcpy(out[0] + first, &value.x, sizeof value.x);
    __builtin_memcpy(out[1] + first, &value.y, sizeof value.y);
    __builtin_memcpy(out[2] + first, &value.z, sizeof value.z);
}

/// Shading::closestOffset of a triangle of one piece.
EDGEWISE_FN dvec2 closestOffset(const dvec2 (&corner)[3], const dvec2& s) {
    mask outside = sideOf(corner[0], corner[1], s) < 0.0;
    outside = EDGEWISE_EITHER(outside, sideOf(corner[1], corner[2], s) < 0.0);
    outside = EDGEWISE_EITHER(outside, sideOf(corner[2], corner[0], s) < 0.0);
    if (!anyLane(outside)) return dvec2(0.0);
    dvec2 best = offsetToSegment(corner[0], corner[1], s);
    real best_px2 = inner(best, best);
    for (int k = 1; k < 3; ++k) {
        const dvec2 offset = offsetToSegment(corner[k], corner[k == 2 ? 0 : 2], s);
        const real px2 = inner(offset, offset);
        const mask farther = px2 >= best_px2;
        best = either(farther, best, offset);
        best_px2 = farther ? best_px2 : px2;
    }
    return either(outside, best, dvec2(0.0));
}

EDGEWISE_FN SurfacePoint placeOf(const LaneFrame& frame, const SurfaceLanes& in, int first) {
    const dvec2 s = load2(in.sample_px, first);
    const dvec2 corner[3] = {load2(in.corner_px[0], first), load2(in.corner_px[1], first),
                             load2(in.corner_px[2], first)};
    const dvec2 uv = imagePlanePoint(s, closestOffset(corner, s), splat2(frame.offset_px), splat2(frame.whole_px),
                                     splat2(frame.fraction_px), frame.scale_px);
    return surfacePointAt(load3(in.p_eye[0], first), load3(in.p_eye[1], first), load3(in.p_eye[2], first), uv,
                          frame.perspective, frame.scale_px);
}

/// Shading::vertexNormalAt, but 0 where that is the flat normal.
EDGEWISE_FN dvec3 normalAt(const SurfaceLanes& in, int first, bool smooth, const dvec3& w) {
    const dvec3 n = load3(in.normal_eye[0], first);
    if (!smooth) return n;
    return unitOrZero(mix3(n, load3(in.normal_eye[1], first), load3(in.normal_eye[2], first), w));
}

/// Shading::litColor.
EDGEWISE_FN dvec3 litColor(const LaneFrame& frame, const LaneMaterial& material, const dvec3& n, const dvec3& p_eye) {
    const dvec3 v = viewFrom(p_eye, frame.uniform_view), base = splat3(material.base);
    dvec3 color = splat3(material.start);
    for (int i = 0; i < frame.light_count; ++i) {
        const LaneLight& light = frame.lights[i];
        const dvec3 towards = splat3(light.towards);
        const real cosine = inner(n, towards);
        const mask lit = cosine > 0.0;
        if (!anyLane(lit)) continue;
        const Halfway known{splat3(light.h), splat(light.fresnel)};
        const dvec3 share = reflectedShare(base, splat(material.metallic), splat(material.roughness), n, v, towards,
                                           frame.uniform_view ? known : halfwayOf(v, towards));
        const dvec3 arriving = cosine * splat3(light.illuminance);
        const dvec3 more(share.x * arriving.x, share.y * arriving.y, share.z * arriving.z);
        color = either(lit, color + more, color);
    }
    return color;
}

/// As many lanes as there are, up to kSurfaceLanes of them.
template <int count>
EDGEWISE_FN void spread(const double (&from)[count], int first, Lanes* out) {
    for (int i = 0; i < count; ++i)
        for (int lane = first; lane < first + kSurfaceLanes; lane += EDGEWISE_LANES) {
            const real value = splat(from[i]);
            __builtin_memcpy(out[i] + lane, &value, sizeof value);
        }
}
}  // namespace

void spread(const LaneTriangle& triangle, int first, SurfaceLanes& lanes);
void spread(const LaneTriangle& triangle, int first, SurfaceLanes& lanes) {
    for (int k = 0; k < 3; ++k) {
        spread(triangle.corner_px[k], first, lanes.corner_px[k]);
        spread(triangle.p_eye[k], first, lanes.p_eye[k]);
        spread(triangle.normal_eye[k], first, lanes.normal_eye[k]);
    }
}

void locate(const LaneFrame& frame, const SurfaceLanes& in, int count, LanePlaces& places);
void locate(const LaneFrame& frame, const SurfaceLanes& in, int count, LanePlaces& places) {
    for (int first = 0; first < count; first += EDGEWISE_LANES) {
        const SurfacePoint at = placeOf(frame, in, first);
        store(at.barycentric, first, places.barycentric);
        store(at.d_dx, first, places.d_dx);
        store(at.d_dy, first, places.d_dy);
        store(at.p_eye, first, places.p_eye);
    }
}

unsigned shade(const LaneFrame& frame, const LaneMaterial& material, bool smooth, const SurfaceLanes& in, int count,
               LaneColors& colors);
unsigned shade(const LaneFrame& frame, const LaneMaterial& material, bool smooth, const SurfaceLanes& in, int count,
               LaneColors& colors) {
    unsigned no_normal = 0;
    for (int first = 0; first < count; first += EDGEWISE_LANES) {
        const SurfacePoint at = placeOf(frame, in, first);
        const dvec3 normal = normalAt(in, first, smooth, at.barycentric);
        no_normal |= laneSet(isZero(normal)) << first;
        store(litColor(frame, material, normal, at.p_eye), first, colors.channel);
    }
    return no_normal & ((1u << count) - 1);
}

}  // namespace edgewise::surface_lanes::EDGEWISE_ISA
