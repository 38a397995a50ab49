// A pixel that edges cross: which surfaces its rays see, and which part of it each takes.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "sdf/surface_tracer.h"

namespace edgewise {

/// Of a pixel's radius: what two hits of one plane may be apart across it.
inline constexpr double kOnPlane = 0.25;

/// A surface as a plane, or what lies behind all surfaces.
struct SurfacePlane {
    bool sky = true;
    glm::dvec3 p_world{0.0}, n_world{0.0};
    std::uint32_t material = 0;
};

/// The plane of the surface that a hit lies above, and sky for a miss.
SurfacePlane planeOf(const sdf::SurfaceHit* hit);
/// Whether both are parts of one smooth surface: their planes are one within a quarter of the pixel's radius
/// there.
bool smoothlyOne(const SurfacePlane& a, const SurfacePlane& b, double radius);
/// The change of the normal from one place to the other per unit of length; 0 for sky and for one place.
double bendBetween(const SurfacePlane& a, const SurfacePlane& b);
/// A point's distance from the plane.
double offPlane(const SurfacePlane& plane, const glm::dvec3& p_world);

struct CellPiece : SurfacePlane {
    glm::dvec2 seen_px{0.0};             ///< where on the film it was met
    double bend = 0.0;                   ///< bendBetween(), as far as neighbours on the surface tell
    std::optional<sdf::SurfaceHit> hit;  ///< met within this pixel, along the ray through seen_px
    double weight = 0.0;                 ///< the area of its parts
    std::uint32_t shade = kUnshaded;     ///< of what is shaded: its place
    static constexpr std::uint32_t kUnshaded = 0xffffffffu;
};

CellPiece pieceOf(const SurfacePlane& plane, const glm::dvec2& seen_px);

/// A convex polygon of which a piece takes a share: all of it, but where samples were counted.
struct CellPart {
    int piece = 0;
    double share = 1.0;
    std::vector<glm::dvec2> polygon_px;
};

struct EdgeCell {
    /// Beside the centre: the four corners, then the standard sample locations, no two in a row or column.
    static constexpr int kCorners = 4, kStandard = 16, kMost = 1 + kCorners + kStandard;
    static constexpr int kUnknown = -1;

    std::size_t pixel = 0;  ///< in the window
    glm::dvec2 centre_px{0.0};
    double sign = 1.0;             ///< of its rays
    double t_start = 0.0;          ///< no surface lies before it in the pixel
    std::optional<double> soft_t;  ///< where a solid that the centre's ray misses comes into its cone
    std::vector<CellPiece> pieces;
    std::vector<CellPart> parts;  ///< of all the pixel, when it is resolved
    int labels[kMost] = {};       ///< of samples: which piece
    double depths[kMost] = {};
    int samples = 1;  ///< that have labels; the centre's first
    bool resolved = false, counted = false;

    glm::dvec2 sampleAt(int i) const;
    /// Of the samples that see the piece the one nearest to their mean; kUnknown: none does.
    int sampleOf(int piece) const;
    void add(CellPart part);
};

/// The standard location i of 16 within a pixel, moved by 1/32 px so that their mean is the centre.
glm::dvec2 countedPlace(const glm::dvec2& centre_px, int i);

}  // namespace edgewise
