// The scene on the screen: eye space, culling, clipping, rounding to the grid, depth planes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "analytic/screen_triangle.h"
#include "pipeline/film.h"
#include "pipeline/progress.h"
#include "pipeline/scene.h"

namespace edgewise {

/// Where the scene's triangles went; every triangle is counted once.
struct ProjectionCounts {
    std::size_t triangles = 0;
    std::size_t no_area = 0;    ///< degenerate in the file, or its whole plane seen edge-on
    std::size_t culled = 0;     ///< back faces of single-sided materials
    std::size_t invisible = 0;  ///< alpha 0 all over
    std::size_t outside = 0;    ///< behind the near plane, beyond the far plane or the guard band
    std::size_t vanished = 0;   ///< no area left on the grid of 2^-32 px
    std::size_t visible = 0;    ///< has pieces
    std::size_t clipped = 0;    ///< of the visible ones: cut by a plane
    std::size_t pieces = 0;
    std::size_t planes = 0;  ///< distinct planes of the file
};

/// What later stages need beside the screen triangles.
struct ScreenPieces {
    /// The pieces of owner i are ScreenScene::triangles[first[i]] .. [first[i + 1]].
    std::vector<std::uint32_t> first;
    std::vector<std::uint8_t> back_facing;     ///< by owner: the back is seen
    std::vector<glm::dvec3> plane_normal_eye;  ///< by plane of ScreenScene: unit, towards the viewer;
                                               ///< bit-equal for coplanar triangles
    ProjectionCounts counts;

    std::span<const ScreenTriangle> of(Owner owner, const ScreenScene& scene) const {
        return std::span(scene.triangles).subspan(first[owner], first[owner + 1] - first[owner]);
    }
};

/// Deterministic whatever the threads. Throws FailureError for a film that exceeds half the guard band,
/// Interrupted when cancelled.
ScreenScene project(const Scene& scene, const ResolvedCamera& camera, const Film& film, ScreenPieces& pieces,
                    Progress& progress);
ScreenScene project(const Scene& scene, const ResolvedCamera& camera, const Film& film, ScreenPieces& pieces);
ScreenScene project(const Scene& scene, const ResolvedCamera& camera, const Film& film);

}  // namespace edgewise
