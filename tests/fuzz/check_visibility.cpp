#include "tests/fuzz/check_visibility.h"

#include <fmt/format.h>

#include <cmath>

#include "analytic/visibility.h"
#include "tests/fuzz/scene_from_bytes.h"
#include "tests/witness/map_scan.h"

namespace edgewise::fuzz {
namespace {

constexpr int kReachPx = 3;
constexpr int kRandomLines = 6;
/// The weights' target, on each px2 that is judged along either axis: what two roundings of one depth may
/// differ in.
constexpr double kWrongPx2 = 1e-12 * 2 * (2 * kReachPx) * (2 * kReachPx);

bool finite(const FinePoint& p) {
    return std::isfinite(p.grid.x) && std::isfinite(p.grid.y) && std::abs(p.rest.x) <= kGridPx &&
           std::abs(p.rest.y) <= kGridPx;
}

std::string checkSegments(const VisibleMap& map) {
    for (const VisibleSegment& s : map.segments) {
        if (!finite(s.a) || !finite(s.b) || !std::isfinite(s.length)) return "a segment is not finite";
        if (s.left == s.right) return fmt::format("a segment has owner {} on both sides", s.left);
        if (s.line >= map.lines.size()) return "a segment lies on no line";
        if (s.b.grid.y + s.b.rest.y < s.a.grid.y + s.a.rest.y) return "a segment runs against its line";
    }
    return {};
}

}  // namespace

std::string checkVisibility(const ScreenScene& scene) {
    const int centre = int(std::floor(kSamplePx)), reach = kReachPx + 1;
    const VisibleMap map =
        visibleMap(scene, {centre - reach, centre - reach, centre + reach + 1, centre + reach + 1});
    if (std::string wrong = checkSegments(map); !wrong.empty()) return wrong;
    const auto verdict = witness::compareMap(scene, map, {kSamplePx, kSamplePx}, kReachPx, 1, kRandomLines);
    if (verdict.wrong_px2 <= kWrongPx2) return {};
    return fmt::format("{:.3g} px2 wrong, {} places without a single owner; first: {}",
                       double(verdict.wrong_px2), verdict.broken, verdict.first);
}

}  // namespace edgewise::fuzz
