#include "pipeline/screen_map.h"

#include <algorithm>
#include <cmath>

#include "analytic/screen_triangle.h"
#include "pipeline/error.h"
#include "pipeline/shading_text.h"

namespace edgewise {
namespace {

/// Only rounding, or a debug offset of thousands of pixels, ever gets here: clip() stays inside the band.
double clampToBand(double x_px) {
    return std::clamp(x_px, -kGuardBandPx, kGuardBandPx);
}

/// In x87 arithmetic: the library's double functions have variants by instruction set that differ in the last
/// bit.
double pixelsPerUnit(const Camera& camera, int height) {
    if (!camera.perspective) return 0.5 * height / camera.ymag;
    return static_cast<double>(0.5L * height / std::tan(0.5L * static_cast<long double>(camera.yfov)));
}

}  // namespace

double roundToGrid(double x_px) {
    return std::nearbyint(x_px * 0x1p32) * kGridPx;
}

glm::dvec2 ScreenMap::toScreen(const glm::dvec3& p_eye) const {
    const double by_w = w(p_eye);
    auto place = [](double fraction, double whole, double from_centre, double offset) {
        return clampToBand(whole + roundToGrid(fraction + from_centre) + offset);
    };
    return {place(fraction_px.x, whole_px.x, scale_px * p_eye.x / by_w, offset_px.x),
            place(fraction_px.y, whole_px.y, -(scale_px * p_eye.y) / by_w, offset_px.y)};
}

glm::dvec2 ScreenMap::toImagePlane(glm::dvec2 p_px, glm::dvec2 delta_px) const {
    return f64::imagePlanePoint(p_px, delta_px, offset_px, whole_px, fraction_px, scale_px);
}

glm::dvec2 ScreenMap::anchorPx() const {
    auto place = [](double whole, double fraction, double offset) {
        return clampToBand(whole + roundToGrid(fraction) + offset);
    };
    return {place(whole_px.x, fraction_px.x, offset_px.x), place(whole_px.y, fraction_px.y, offset_px.y)};
}

ScreenMap makeScreenMap(const ResolvedCamera& camera, const Film& film) {
    if (std::max(film.width, film.height) > kGuardBandPx / 2)
        throw FailureError("size", "a side is longer than 524288 pixels, half the guard band");
    ScreenMap map;
    map.perspective = camera.camera.perspective;
    map.scale_px = pixelsPerUnit(camera.camera, film.height);
    const glm::dvec2 principal = glm::dvec2(film.width, film.height) * 0.5 - film.shift_px;
    map.whole_px = glm::floor(principal);
    map.fraction_px = principal - map.whole_px;
    map.offset_px = film.debug_offset_px;
    return map;
}

}  // namespace edgewise
