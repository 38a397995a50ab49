// Visible maps made by hand: triangles that do not overlap, on a background.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "analytic/pixel_weights.h"

namespace edgewise::test {

struct MapTriangle {
    std::array<glm::dvec2, 3> p;
    Owner owner;
};

struct MapSegment {
    VisibleSegment segment;
    CarrierLine line;
};

inline double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// The line and segment between two points on the grid, directed towards +y, or -x if horizontal.
inline MapSegment segmentBetween(glm::dvec2 a, glm::dvec2 b, std::uint32_t index) {
    if (a.y > b.y || (a.y == b.y && a.x < b.x)) std::swap(a, b);
    const glm::dvec2 e = b - a;
    MapSegment s;
    s.line.origin = a;
    s.line.nx_hi = -e.y;
    s.line.ny_hi = e.x;
    s.line.length = static_cast<double>(
        std::sqrt(static_cast<long double>(e.x) * e.x + static_cast<long double>(e.y) * e.y));
    s.line.direction = e / s.line.length;
    s.segment.a.grid = a;
    s.segment.b.grid = b;
    s.segment.length = s.line.length;
    s.segment.line = index;
    return s;
}

inline std::vector<MapSegment> segmentsOf(const std::vector<MapTriangle>& triangles) {
    using Key = std::array<double, 4>;
    std::map<Key, MapSegment> edges;
    for (const MapTriangle& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            MapSegment fresh =
                segmentBetween(t.p[i], t.p[(i + 1) % 3], static_cast<std::uint32_t>(edges.size()));
            const glm::dvec2 a = fresh.segment.a.grid, b = fresh.segment.b.grid;
            MapSegment& edge = edges.try_emplace(Key{a.x, a.y, b.x, b.y}, fresh).first->second;
            (cross(b - a, t.p[(i + 2) % 3] - a) > 0 ? edge.segment.left : edge.segment.right) = t.owner;
        }
    }
    std::vector<MapSegment> list;
    for (const auto& [key, edge] : edges) list.push_back(edge);
    return list;
}

/// The owner of a generic point.
inline Owner ownerAt(const std::vector<MapTriangle>& triangles, glm::dvec2 q) {
    for (const MapTriangle& t : triangles) {
        const double side = cross(t.p[1] - t.p[0], t.p[2] - t.p[0]) > 0 ? 1 : -1;
        bool inside = true;
        for (int i = 0; i < 3; ++i)
            inside = inside && side * cross(t.p[(i + 1) % 3] - t.p[i], q - t.p[i]) >= 0;
        if (inside) return t.owner;
    }
    return kBackground;
}

using Weights = std::vector<std::map<Owner, FixedWeight>>;

inline Weights weightsOf(PixelWeights& weights, double radius, const std::vector<MapTriangle>& triangles,
                         const std::vector<MapSegment>& segments, glm::dvec2 sample, int count = 8) {
    weights.begin(sample, count);
    for (const MapSegment& s : segments) weights.add(s.segment, s.line, s.segment.left, s.segment.right);
    std::array<Owner, 8> base{};
    for (int i = 0; i < count; ++i) base[i] = ownerAt(triangles, {sample.x + i + radius, sample.y});
    std::vector<OwnerWeight> out;
    std::array<std::size_t, 9> offset{};
    weights.finish(base.data(), out, offset.data());
    Weights result(count);
    for (int i = 0; i < count; ++i)
        for (std::size_t k = offset[i]; k < offset[i + 1]; ++k) result[i][out[k].owner] = out[k].weight;
    return result;
}

inline double toDouble(FixedWeight weight) {
    return static_cast<double>(weight) * 0x1p-60;
}

}  // namespace edgewise::test
