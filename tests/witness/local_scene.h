// The triangles that reach one sample's support, in coordinates relative to the sample.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "analytic/screen_triangle.h"
#include "tests/witness/wide.h"

namespace edgewise::witness {

/// a u + b v + c with a^2 + b^2 = 1 (a signed distance in px), or a = b = 0 and c the sign of a constant.
struct Affine {
    Real a = 0, b = 0, c = 0;
    Real at(Real u, Real v) const { return a * u + b * v + c; }
};

/// One side: the line through it (positive inside) and u as a function of v where the side is not horizontal.
struct Side {
    Affine line;
    Real v_lo = 0, v_hi = 0;
    Real u_at_0 = 0, slope = 0;
    Real u(Real v) const { return u_at_0 + slope * v; }
};

struct LocalTriangle {
    Owner owner = 0;
    std::uint32_t plane = 0;
    bool see_through = false;
    std::array<std::array<Real, 2>, 3> corner{};
    std::array<Side, 3> side{};
    Real v_lo = 0, v_hi = 0;
    /// The least of the three signed distances: >= 0 inside.
    Real depthInside(Real u, Real v) const;
};

class LocalScene {
  public:
    /// Keeps what meets the square of half width `radius` around the sample and is not wholly behind a
    /// triangle that covers that square.
    LocalScene(const ScreenScene& scene, glm::dvec2 sample_px, Real radius);

    const std::vector<LocalTriangle>& triangles() const { return triangles_; }
    /// Depth of i minus depth of j: positive where i is nearer; exactly 0 on one plane.
    const Affine& nearer(std::size_t i, std::size_t j) const { return nearer_[i * triangles_.size() + j]; }
    /// Does i win over j at (u, v)? Equal depth: the lower index.
    bool wins(std::size_t i, std::size_t j, Real u, Real v) const;

  private:
    void dropHidden(Real radius);
    std::vector<LocalTriangle> triangles_;
    std::vector<DepthPlane> planes_;
    std::array<Quad, 2> anchor_{};
    std::vector<Affine> nearer_;
    Affine difference(const LocalTriangle& i, const LocalTriangle& j) const;
};

/// The owner of a point, by asking every triangle: nothing is culled, nothing is sorted.
Owner ownerAt(const ScreenScene& scene, glm::dvec2 point_px);

}  // namespace edgewise::witness
