#include "tests/witness/hard_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tests/witness/scene_builder.h"

namespace edgewise::witness {
namespace {

using glm::dvec2;
using Polygon = std::vector<dvec2>;

double cross(dvec2 a, dvec2 b, dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The part of a convex polygon on the positive side of a -> b (Sutherland and Hodgman).
Polygon clip(const Polygon& polygon, dvec2 a, dvec2 b) {
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const dvec2 p = polygon[k], q = polygon[(k + 1) % polygon.size()];
        const double at_p = cross(a, b, p), at_q = cross(a, b, q);
        if (at_p >= 0) kept.push_back(p);
        if ((at_p < 0) != (at_q < 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    return kept;
}

Polygon overlap(const ScreenTriangle& s, const ScreenTriangle& t) {
    Polygon polygon(s.p_px.begin(), s.p_px.end());
    for (int k = 0; k < 3 && !polygon.empty(); ++k) polygon = clip(polygon, t.p_px[k], t.p_px[(k + 1) % 3]);
    double area = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k) area += cross(polygon[0], polygon[k - 1], polygon[k]);
    if (area < 1e-9) polygon.clear();
    return polygon;
}

/// Least and greatest depth of s above t on their overlap.
std::pair<double, double> depthRange(const ScreenScene& scene, const ScreenTriangle& s,
                                     const ScreenTriangle& t, const Polygon& where) {
    const DepthPlane &a = scene.planes[s.plane], &b = scene.planes[t.plane];
    double lo = INFINITY, hi = -INFINITY;
    for (dvec2 p : where) {
        const double z = (a.dz_dx - b.dz_dx) * (p.x - scene.anchor_px.x) +
                         (a.dz_dy - b.dz_dy) * (p.y - scene.anchor_px.y) + (a.z_anchor - b.z_anchor);
        lo = std::min(lo, z), hi = std::max(hi, z);
    }
    return {lo, hi};
}

void countPairs(const ScreenScene& scene, HardCases& cases) {
    std::set<std::pair<Owner, Owner>> over;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        for (std::size_t j = i + 1; j < scene.triangles.size(); ++j) {
            const ScreenTriangle &s = scene.triangles[i], &t = scene.triangles[j];
            const Polygon where = overlap(s, t);
            if (where.empty()) continue;
            if (s.plane == t.plane) {
                ++cases.coplanar_overlaps;
                continue;
            }
            const auto [lo, hi] = depthRange(scene, s, t, where);
            cases.piercing_pairs += lo < 0 && hi > 0;
            cases.near_coincident_pairs += std::max(-lo, hi) < 1e-5;
            if (lo > 0) over.insert({s.owner, t.owner});
            if (hi < 0) over.insert({t.owner, s.owner});
        }
    for (const auto& [a, b] : over)
        for (auto c = over.lower_bound({b, 0}); c != over.end() && c->first == b; ++c)
            cases.depth_cycles += a < b && a < c->second && over.contains({c->second, a});
}

void countSide(dvec2 a, dvec2 b, HardCases& cases) {
    const dvec2 d = b - a;
    cases.horizontal += d.y == 0;
    cases.vertical += d.x == 0;
    if (d.x != 0 && d.y != 0) return;
    const double at = d.y == 0 ? a.y : a.x;
    cases.on_pixel_borders += at == std::floor(at);
    cases.through_samples += at - 0.5 == std::floor(at - 0.5);
}

void countShape(const ScreenTriangle& t, HardCases& cases) {
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
        const dvec2 a = t.p_px[k], b = t.p_px[(k + 1) % 3];
        longest = std::max(longest, glm::length(b - a));
        countSide(a, b, cases);
        cases.corners_on_samples += a.x - 0.5 == std::floor(a.x - 0.5) && a.y - 0.5 == std::floor(a.y - 0.5);
    }
    cases.slivers += longest > 1e-3 && cross(t.p_px[0], t.p_px[1], t.p_px[2]) / longest < 1e-3;
    cases.tiny += longest < 1e-3;
    cases.huge += longest > 1e4;
}

void countSides(const ScreenScene& scene, HardCases& cases) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    std::map<std::pair<double, double>, std::size_t> ends;
    for (const ScreenTriangle& t : scene.triangles)
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            cases.shared_sides += sides.contains({t.vertex[next], t.vertex[k]});
            sides.insert({t.vertex[k], t.vertex[next]});
            cases.largest_fan = std::max(cases.largest_fan, ++ends[{t.p_px[k].x, t.p_px[k].y}]);
        }
    for (const auto& [end, count] : ends)
        for (const ScreenTriangle& t : scene.triangles)
            for (int k = 0; k < 3; ++k) {
                const dvec2 p(end.first, end.second), a = t.p_px[k], b = t.p_px[(k + 1) % 3];
                const double along = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
                const double off = std::abs(cross(a, b, p)) / glm::length(b - a);
                cases.t_junctions += along > 0.001 && along < 0.999 && off < 4 * kGridPx;
            }
}

}  // namespace

HardCases& HardCases::operator+=(const HardCases& o) {
    for (auto member :
         {&HardCases::triangles, &HardCases::piercing_pairs, &HardCases::depth_cycles,
          &HardCases::shared_sides, &HardCases::t_junctions, &HardCases::coplanar_overlaps,
          &HardCases::near_coincident_pairs, &HardCases::slivers, &HardCases::tiny, &HardCases::huge,
          &HardCases::horizontal, &HardCases::vertical, &HardCases::on_pixel_borders,
          &HardCases::through_samples, &HardCases::corners_on_samples})
        this->*member += o.*member;
    largest_fan = std::max(largest_fan, o.largest_fan);
    return *this;
}

HardCases countHardCases(const ScreenScene& scene) {
    HardCases cases;
    cases.triangles = scene.triangles.size();
    for (const ScreenTriangle& t : scene.triangles) countShape(t, cases);
    countSides(scene, cases);
    countPairs(scene, cases);
    return cases;
}

std::string toString(const HardCases& c) {
    return fmt::format(
        "triangles {} piercing {} cycles {} shared {} T {} coplanar {} near {} slivers {} tiny {} huge {} "
        "horizontal {} vertical {} borders {} through {} corners {} fan {}",
        c.triangles, c.piercing_pairs, c.depth_cycles, c.shared_sides, c.t_junctions, c.coplanar_overlaps,
        c.near_coincident_pairs, c.slivers, c.tiny, c.huge, c.horizontal, c.vertical, c.on_pixel_borders,
        c.through_samples, c.corners_on_samples, c.largest_fan);
}

}  // namespace edgewise::witness
