#include "pipeline/clip.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "analytic/double_double.h"
#include "analytic/screen_triangle.h"

namespace edgewise {
namespace {

/// Clipped this far inside the guard band, so that a debug offset up to 4096 px stays within it.
constexpr double kClipBandPx = kGuardBandPx - 4096.0;

/// A perspective camera's near plane is in front of the eye, whatever the file says: w never reaches 0.
constexpr double kSmallestNear = 0x1p-300;

constexpr int kNear = 0, kFirstSide = 1, kFar = 5;

f64::dd distance(const glm::dvec3& a, double b, const glm::dvec3& p) {
    using namespace f64;
    return ddAdd(ddAdd(twoProd(a.x, p.x), twoProd(a.y, p.y)), ddAdd(twoProd(a.z, p.z), ddFrom(b)));
}

}  // namespace

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

std::uint8_t ClipVolume::outcode(const glm::dvec3& p_eye) const {
    unsigned code = 0;
    for (int i = 0; i < plane_count_; ++i)
        if (planes_[i].at(p_eye) < 0.0) code |= 1u << i;
    return static_cast<std::uint8_t>(code);
}

/// Formed in double-double from the lexicographically smaller endpoint and rounded once: a far endpoint costs
/// a near crossing no digits.
glm::dvec3 ClipVolume::crossing(int plane, const glm::dvec3& p, const glm::dvec3& q) const {
    using namespace f64;
    const bool ordered = std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    const glm::dvec3 &a = ordered ? p : q, &b = ordered ? q : p;
    const dd h_a = distance(planes_[plane].a, planes_[plane].b, a);
    const dd fall = ddSub(h_a, distance(planes_[plane].a, planes_[plane].b, b));
    const dd t = fall.hi == 0.0 ? ddFrom(0.5) : ddDiv(h_a, fall);
    glm::dvec3 made;
    for (int axis = 0; axis < 3; ++axis)
        made[axis] = ddAdd(ddFrom(a[axis]), ddMul(t, ddSub(ddFrom(b[axis]), ddFrom(a[axis])))).hi;
    if (plane == kNear) made.z = planes_[kNear].b;
    if (plane == kFar) made.z = -planes_[kFar].b;
    return made;
}

void ClipVolume::clip(ClipPolygon& polygon, std::uint8_t codes) const {
    for (int plane = 0; plane < plane_count_; ++plane) {
        if (!(codes >> plane & 1)) continue;
        const ClipPolygon old = polygon;
        polygon.size = 0;
        for (int i = 0; i < old.size; ++i) {
            const int next = (i + 1) % old.size;
            const bool inside = planes_[plane].at(old.p_eye[i]) >= 0.0;
            const bool next_inside = planes_[plane].at(old.p_eye[next]) >= 0.0;
            if (inside) polygon.push(old.p_eye[i], old.vertex[i]);
            if (inside != next_inside) polygon.push(crossing(plane, old.p_eye[i], old.p_eye[next]), kNone);
        }
        if (polygon.size < 3) return;
    }
}

}  // namespace edgewise
