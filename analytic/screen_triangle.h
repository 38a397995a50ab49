// What visibility sees of a scene: triangles on the screen, on a grid, with affine depth.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace edgewise {

/// Index of a triangle of the scene; the lower index wins where depths are equal.
using Owner = std::uint32_t;
/// The background is an owner like any other.
inline constexpr Owner kBackground = 0xffffffffu;

/// Screen positions are multiples of this, in pixels (x right, y down), inside +-kGuardBandPx:
/// a difference of two is exact in double, a product of two differences fits 128 bits.
inline constexpr double kGridPx = 0x1p-32;
inline constexpr double kGuardBandPx = 0x1p20;

/// Depth as an affine function of the screen; the larger value is nearer.
///     z(x, y) = dz_dx (x - anchor.x) + dz_dy (y - anchor.y) + z_anchor
/// These three doubles ARE the depth of the scene: comparisons of them are exact.
struct DepthPlane {
    double dz_dx = 0.0;
    double dz_dy = 0.0;
    double z_anchor = 0.0;
};

/// A piece of a triangle after clipping; several pieces may share one owner.
struct ScreenTriangle {
    std::array<glm::dvec2, 3> p_px;       ///< on the grid; cross(p1 - p0, p2 - p0) > 0, never 0
    std::array<std::uint32_t, 3> vertex;  ///< equal ids are one point in space: both planes pass through it
    Owner owner = 0;
    std::uint32_t plane = 0;  ///< index into ScreenScene::planes; triangles coplanar in the file share it
};

/// All pieces that can be seen, in owner order.
struct ScreenScene {
    std::vector<ScreenTriangle> triangles;
    std::vector<DepthPlane> planes;
    std::vector<std::uint8_t> see_through;  ///< by owner: what lies behind it shows; empty: all are opaque
    glm::dvec2 anchor_px{0.0};              ///< on the grid; moves with the triangles

    bool seesThrough(Owner owner) const { return !see_through.empty() && see_through[owner] != 0; }
};

}  // namespace edgewise
