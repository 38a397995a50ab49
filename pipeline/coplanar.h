// Triangles of one node that are exactly coplanar in the file: they share one depth plane, so that duplicates
// and decals resolve by index and not by rounding.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "analytic/double_double.h"
#include "pipeline/scene.h"

namespace edgewise {

/// The plane through a triangle of the file, as it was written there.
struct FilePlane {
    std::uint32_t geometry = 0;  ///< of the representative: the widest triangle, the first of equals
    std::uint32_t triangle = 0;
};

/// cross(b - a, c - a) of a triangle, relative error <= 2^-104 a component, slivers too.
std::array<f64::dd, 3> fileNormal(const Geometry& geometry, std::uint32_t triangle);

struct CoplanarGroups {
    /// By the contract's triangle index: the plane, or kNone for a triangle without area in the file.
    std::vector<std::uint32_t> plane_of;
    /// 1 where the triangle is wound against its plane's representative.
    std::vector<std::uint8_t> reversed;
    std::vector<FilePlane> planes;  ///< in order of their first triangle
};

/// Groups by exact arithmetic on the float32 positions of the file. The result depends on the scene alone.
CoplanarGroups findCoplanar(const Scene& scene);

}  // namespace edgewise
