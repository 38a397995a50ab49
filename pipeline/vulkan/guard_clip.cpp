#include "pipeline/vulkan/guard_clip.h"

#include <tbb/parallel_for.h>

#include <array>
#include <glm/common.hpp>
#include <utility>

#include "pipeline/vulkan/layouts.h"

namespace edgewise::vulkan {
namespace {

using Polygon = std::vector<glm::dvec2>;

/// The same point whichever way the edge runs: from its lower end on.
glm::dvec2 crossing(glm::dvec2 a, glm::dvec2 b, int axis, double border) {
    if (a[axis] > b[axis]) std::swap(a, b);
    const double along = (border - a[axis]) / (b[axis] - a[axis]);
    glm::dvec2 p = a + (b - a) * along;
    p[axis] = border;
    return p;
}

/// The part on the side of the border where sign * p[axis] is the smaller (Sutherland, Hodgman 1974).
Polygon cutAt(const Polygon& polygon, int axis, double border, double sign) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const bool a_inside = sign * a[axis] <= sign * border, b_inside = sign * b[axis] <= sign * border;
        if (a_inside) kept.push_back(a);
        if (a_inside != b_inside) kept.push_back(crossing(a, b, axis, border));
    }
    return kept;
}

Polygon cutToBox(const ScreenTriangle& t, const ScreenBox& box) {
    Polygon polygon(t.p_px.begin(), t.p_px.end());
    for (int axis = 0; axis < 2; ++axis) {
        polygon = cutAt(polygon, axis, box.low[axis], -1.0);
        polygon = cutAt(polygon, axis, box.high[axis], 1.0);
    }
    return polygon;
}

bool exceeds(glm::dvec2 low, glm::dvec2 high, const ScreenBox& box) {
    return low.x < box.low.x || low.y < box.low.y || high.x > box.high.x || high.y > box.high.y;
}

bool misses(glm::dvec2 low, glm::dvec2 high, const ScreenBox& box) {
    return high.x < box.low.x || high.y < box.low.y || low.x > box.high.x || low.y > box.high.y;
}

void addPiece(const ScreenScene& scene, std::uint32_t i, const ScreenBox& target, const ScreenBox& guard,
              DrawnPieces& out) {
    const ScreenTriangle& t = scene.triangles[i];
    const glm::dvec2 low = glm::min(glm::min(t.p_px[0], t.p_px[1]), t.p_px[2]),
                     high = glm::max(glm::max(t.p_px[0], t.p_px[1]), t.p_px[2]);
    if (misses(low, high, target)) return;
    if (!exceeds(low, high, guard)) return out.ids.push_back(i);
    const Polygon polygon = cutToBox(t, guard);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
        out.ids.push_back(kClippedPiece | static_cast<std::uint32_t>(out.clipped.size()));
        out.clipped.push_back({{polygon[0], polygon[k - 1], polygon[k]}, t.vertex, t.owner, t.plane});
    }
}

void append(const DrawnPieces& part, DrawnPieces& all) {
    const auto clipped_before = static_cast<std::uint32_t>(all.clipped.size());
    for (const std::uint32_t id : part.ids) all.ids.push_back(id & kClippedPiece ? id + clipped_before : id);
    all.clipped.insert(all.clipped.end(), part.clipped.begin(), part.clipped.end());
}

}  // namespace

DrawnPieces piecesFor(const ScreenScene& scene, const ScreenBox& target, const ScreenBox& guard) {
    constexpr std::size_t kChunks = 16;
    std::array<DrawnPieces, kChunks> parts;
    const std::size_t count = scene.triangles.size();
    tbb::parallel_for(std::size_t{0}, kChunks, [&](std::size_t chunk) {
        for (std::size_t i = count * chunk / kChunks; i < count * (chunk + 1) / kChunks; ++i)
            addPiece(scene, static_cast<std::uint32_t>(i), target, guard, parts[chunk]);
    });
    DrawnPieces all;
    for (const DrawnPieces& part : parts) append(part, all);
    return all;
}

}  // namespace edgewise::vulkan
