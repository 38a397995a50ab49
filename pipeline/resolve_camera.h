// Which camera a picture is made with, and how many pixels its film has.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "pipeline/film.h"

namespace edgewise {

/// The flags --camera, --eye, --target, --fovy, --size as the user gave them.
struct CameraOptions {
    std::string camera;  ///< NAME|INDEX; empty: none asked for
    std::optional<glm::dvec3> eye, target;
    std::optional<double> fovy_degrees;
    std::optional<glm::ivec2> size;
};

/// Sides of a film beyond this leave the guard band of the screen coordinates.
inline constexpr int kMaxFilmSide = 1 << 20;
inline constexpr int kDefaultFilmWidth = 1024;

/// The camera, and the film's width, height and crop (set to the whole film; --crop narrows it afterwards).
///
/// In this order:
///  1. --eye (then "command line"): looks at --target (default: the centre of the scene's bounds), +y up (or
///  -z
///     where it looks along y), --fovy (default 45 degrees); near plane at 1/1024 of the way to the target,
///     no far plane. --camera beside it, or --target without it, is an error.
///  2. --camera NAME|INDEX: a node's or camera's name, first in depth-first order; else an index ("file").
///  3. the first camera of the scene ("file").
///  4. "framing": from the direction (1, 0.8, 1.2), above and to the side, 45 degrees, at the distance where
///  the
///     sphere around the scene's bounds just fits the narrower of both angles, with 5% to spare. The near
///     plane is half-way to the sphere, the far one a radius behind it; of SDF scenes, whose unbounded parts
///     have no sphere, near is 1/1024 of the way and far where the scene's rays end. A scene without extent
///     (empty, one point) gets a sphere of radius 1, or of 2^-20 of its distance from the origin if that is
///     more.
/// --fovy alone replaces the yfov of a perspective camera of the file.
///
/// Film: --size, else 1024 wide and 1024 / aspect high, rounded, at least 1; square without an aspect. yfov
/// (ymag) holds and the horizontal follows: the result's aspect is width / height, its xmag ymag * aspect.
///
/// Throws InputError for a flag that fits nothing, a size outside [1, 2^20], and lenses without a picture:
/// yfov not in (0, pi), ymag <= 0, aspect <= 0, znear <= 0 (orthographic: < 0), zfar <= znear.
ResolvedCamera resolveCamera(const Scene& scene, const CameraOptions& options, Film& film);

}  // namespace edgewise
