#include "analytic/sheet_certificate.h"

#include <algorithm>
#include <cmath>

namespace edgewise {
namespace {

/// The smallest cross(e, p - a) over the edges of t: positive inside.
double innerDistance(const ScreenTriangle& t, glm::dvec2 p) {
    double smallest = HUGE_VAL;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 a = t.p_px[k], e = t.p_px[(k + 1) % 3] - a, d = p - a;
        smallest = std::min(smallest, e.x * d.y - e.y * d.x);
    }
    return smallest;
}

/// Whether p lies in exactly one triangle; false also where rounding leaves it open.
bool coveredOnce(const ScreenScene& scene, std::span<const std::uint32_t> triangles, glm::dvec2 p) {
    int inside = 0;
    for (const std::uint32_t i : triangles) {
        const int side = sideOfTriangle(scene.triangles[i], p);
        if (side == 0) return false;
        inside += side > 0;
    }
    return inside == 1;
}

}  // namespace

void SheetCertificate::emitEdge(const ScreenScene& scene, const CellFrame& frame,
                                std::span<const std::uint32_t> triangles, const SharedEdge& edge,
                                CellOutput& out) {
    const Owner left = scene.triangles[triangles[edge.with]].owner,
                right = scene.triangles[triangles[edge.against]].owner;
    const Carrier carrier = edgeCarrier(scene, edge.canonical);
    if (carrier.horizontal()) {
        LeafHorizontal h;
        if (left != right && clipHorizontalEdge(frame, carrier, h))
            out.segments.push_back({lineKey(carrier), carrier.ref, left, right, h.high, h.low});
        return;
    }
    LeafLine line;
    line.carrier = carrier;
    if (!clipEdge(frame, line) || !line.runsInside()) return;
    if (left != right)
        out.segments.push_back({lineKey(carrier), carrier.ref, left, right, line.enter, line.exit});
    crossings_.add(frame, line, line.enter, line.exit, left, right);
}

bool SheetCertificate::run(const ScreenScene& scene, const Cell& cell, glm::dvec2 origin,
                           std::span<const std::uint32_t> triangles, const SharedEdges& shared,
                           CellOutput& out) {
    if (triangles.empty() || !shared.allPaired()) return false;
    const auto points = genericPoints(cell);
    if (std::ranges::none_of(points, [&](glm::dvec2 p) { return coveredOnce(scene, triangles, p); }))
        return false;
    const CellFrame frame(cell, origin);
    crossings_.clear();
    const std::size_t emitted = out.segments.size();
    for (const SharedEdge& edge : shared.edges()) emitEdge(scene, frame, triangles, edge, out);
    if (!crossings_.sort()) {
        out.segments.resize(emitted);
        return false;
    }
    // A row without crossings is within one triangle.
    const auto holder = [&](glm::dvec2 p) {
        const auto inner = [&](std::uint32_t i) { return innerDistance(scene.triangles[i], p); };
        return scene.triangles[*std::ranges::max_element(triangles, {}, inner)].owner;
    };
    crossings_.emit(frame.cell, holder, out.rows);
    ++out.counts.certified;
    return true;
}

}  // namespace edgewise
