#include "pipeline/clip.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "analytic/double_double.h"
#include "analytic/screen_triangle.h"

namespace edgewise {
namespace {

/// Clipped this far inside the guard band, so that a debug offset up to 4096 px stays within it.
constexpr double kClipBandPx = kGuardBandPx - 4096.0;

/// A perspective camera's near plane is in front of the eye, whatever the file says: w never reaches 0.
constexpr double kSmallestNear = 0x1p-300;

constexpr int kNear = 0, kFirstSide = 1, kFar = 5;

f64::dd distance(const glm::dvec3& a, double b, const EyePoint& q) {
    using namespace f64;
    dd sum = ddFrom(b);
    for (int axis = 0; axis < 3; ++axis) sum = ddAdd(sum, ddMulReal(dd{q.p[axis], q.rest[axis]}, a[axis]));
    return sum;
}

}  // namespace

EyePoint refined(const glm::dmat4& m, const glm::dvec3& p_world) {
    using namespace f64;
    EyePoint out;
    for (int row = 0; row < 3; ++row) {
        dd sum = ddFrom(m[3][row]);
        for (int k = 0; k < 3; ++k) sum = ddAdd(sum, twoProd(m[k][row], p_world[k]));
        out.p[row] = sum.hi, out.rest[row] = sum.lo;
    }
    return out;
}

ClipVolume::ClipVolume(const Camera& camera, const ScreenMap& map) {
    const double znear = map.perspective ? std::max(camera.znear, kSmallestNear) : camera.znear;
    planes_[kNear] = {{0.0, 0.0, -1.0}, -znear};
    // x_px >= -band: (principal + band) w + scale x >= 0, and so on; w = -z or 1.
    auto side = [&](double per_w, glm::dvec3 slope) {
        return map.perspective ? Plane{slope - glm::dvec3(0.0, 0.0, per_w), 0.0} : Plane{slope, per_w};
    };
    const glm::dvec2 principal = map.whole_px + map.fraction_px;
    const double s = map.scale_px;
    planes_[kFirstSide] = side(principal.x + kClipBandPx, {s, 0.0, 0.0});
    planes_[kFirstSide + 1] = side(kClipBandPx - principal.x, {-s, 0.0, 0.0});
    planes_[kFirstSide + 2] = side(principal.y + kClipBandPx, {0.0, -s, 0.0});
    planes_[kFirstSide + 3] = side(kClipBandPx - principal.y, {0.0, s, 0.0});
    plane_count_ = camera.zfar ? kPlanes : kPlanes - 1;
    if (camera.zfar) planes_[kFar] = {{0.0, 0.0, 1.0}, *camera.zfar};
}

std::uint8_t ClipVolume::outcode(const glm::dmat4& m, const glm::dvec3& p_world, glm::dvec3& p_eye) const {
    // p_eye has three roundings of a sum of this size, at() four more.
    const glm::dvec3 p = glm::abs(p_world);
    double size = 0.0;
    for (int row = 0; row < 3; ++row)
        size = std::max(size, std::abs(m[0][row]) * p.x + std::abs(m[1][row]) * p.y +
                                  std::abs(m[2][row]) * p.z + std::abs(m[3][row]));
    std::optional<EyePoint> exact;
    unsigned code = 0;
    for (int i = 0; i < plane_count_; ++i) {
        const Plane& plane = planes_[i];
        const double h = plane.at(p_eye);
        const glm::dvec3 a = glm::abs(plane.a);
        const bool sure = std::abs(h) > 8 * 0x1p-53 * ((a.x + a.y + a.z) * size + std::abs(plane.b));
        if (!sure && !exact) exact = refined(m, p_world);
        if (sure ? h < 0.0 : !inside(i, *exact)) code |= 1u << i;
    }
    if (exact) p_eye = exact->p;
    return static_cast<std::uint8_t>(code);
}

bool ClipVolume::inside(int plane, const EyePoint& p) const {
    return distance(planes_[plane].a, planes_[plane].b, p).hi >= 0.0;
}

/// Formed in double-double from the end nearer to the plane: the way from there is at most half the edge, and
/// the roundings are relative to it. From the far end of an edge over 20 decades a crossing keeps double's
/// digits alone, and where a second plane cuts between two such crossings, close together, hardly any are
/// left.
EyePoint ClipVolume::crossing(int plane, const EyePoint& p, const EyePoint& q) const {
    using namespace f64;
    const dd h_p = distance(planes_[plane].a, planes_[plane].b, p);
    const dd h_q = distance(planes_[plane].a, planes_[plane].b, q);
    // The signs differ, so that the sum has that of the farther end; the one inside wins a tie.
    const bool inside_is_nearer = ddAdd(h_p, h_q).hi <= 0.0, from_p = (h_p.hi >= 0.0) == inside_is_nearer;
    const EyePoint &a = from_p ? p : q, &b = from_p ? q : p;
    const dd h_a = from_p ? h_p : h_q, h_b = from_p ? h_q : h_p;
    const dd t = ddDiv(h_a, ddSub(h_a, h_b));
    EyePoint made;
    for (int axis = 0; axis < 3; ++axis) {
        const dd from{a.p[axis], a.rest[axis]}, to{b.p[axis], b.rest[axis]};
        const dd at = ddAdd(from, ddMul(t, ddSub(to, from)));
        made.p[axis] = at.hi, made.rest[axis] = at.lo;
    }
    if (plane == kNear) made.p.z = planes_[kNear].b, made.rest.z = 0.0;
    if (plane == kFar) made.p.z = -planes_[kFar].b, made.rest.z = 0.0;
    return made;
}

void ClipVolume::clip(ClipPolygon& polygon, std::uint8_t codes) const {
    for (int plane = 0; plane < plane_count_; ++plane) {
        if (!(codes >> plane & 1)) continue;
        const ClipPolygon old = polygon;
        polygon.size = 0;
        for (int i = 0; i < old.size; ++i) {
            const int next = (i + 1) % old.size;
            const bool here_inside = inside(plane, old.eye[i]), next_inside = inside(plane, old.eye[next]);
            if (here_inside) polygon.push(old.eye[i], old.vertex[i]);
            if (here_inside != next_inside) polygon.push(crossing(plane, old.eye[i], old.eye[next]), kNone);
        }
        if (polygon.size < 3) return;
    }
}

}  // namespace edgewise
