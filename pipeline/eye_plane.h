// The file's planes in eye space, and from there depth as an affine function of the screen. Double-double
// throughout, rounded once at the end: triangles that share a plane in the file share the bits of its depth.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "analytic/screen_triangle.h"
#include "pipeline/coplanar.h"
#include "pipeline/eye_plane_lanes.h"
#include "pipeline/screen_map.h"

namespace edgewise {

/// n . p = d, n being cross(b - a, c - a) of the representative, as it is seen.
struct EyePlane {
    double facing = 0.0;              ///< positive where the eye sees the front, 0 edge-on: the exact sign
    glm::dvec3 normal{0, 0, 1};       ///< unit, towards the viewer
    std::optional<DepthPlane> depth;  ///< relative to the map's anchor; none: seen edge-on
};

/// The code of one instruction set ("scalar", "sse2", "avx2", "avx512"); null where this machine lacks it.
/// All give the same bits.
EyePlanesFunction eyePlanesFor(const char* instruction_set);

class EyePlanes {
  public:
    /// Throws std::invalid_argument for an instruction set in EDGEWISE_ISA that is not there.
    EyePlanes(const Scene& scene, const glm::dmat4& camera_from_world, const ScreenMap& map);

    EyePlane of(const FilePlane& plane) const;

    /// Depths and normals of planes of which none is seen edge-on. On all threads.
    void fill(std::span<const FilePlane> planes, std::vector<DepthPlane>& depths,
              std::vector<glm::dvec3>& normals) const;

  private:
    void load(const FilePlane& plane, int lane, PlanesIn& in) const;
    EyePlane finished(const PlanesOut& out, int lane) const;
    void make(std::span<const FilePlane> planes, PlanesOut& out) const;

    const Scene& scene_;
    EyeMap eye_;
    std::vector<std::optional<WorldMap>> world_;  ///< by geometry; none: planes are given in the world
    EyePlanesFunction planes_;
};

}  // namespace edgewise
