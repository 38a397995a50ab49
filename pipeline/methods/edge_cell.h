// A pixel that edges cross: which surfaces its rays see, and which part of it each takes.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "sdf/film_line.h"
#include "sdf/scene_trace.h"
#include "sdf/surface_light.h"

namespace edgewise {

/// A surface as a plane, or what lies behind all surfaces.
struct CellPiece {
    bool sky = true;
    glm::dvec3 p_world{0.0}, n_world{0.0};
    std::uint32_t material = 0;
    glm::dvec2 seen_px{0.0};  ///< where on the film it was met
    double bend =
        0.0;  ///< the change of the normal per unit of length, as far as neighbours on the surface tell
    std::optional<sdf::SurfaceHit> hit;  ///< met within this pixel, along the ray through seen_px
    double weight = 0.0;
};

/// The plane of a hit, and sky for a miss.
CellPiece pieceOf(const sdf::SurfaceHit* hit, const glm::dvec2& seen_px);
/// Whether both are parts of one smooth surface: their planes are one within a quarter of the pixel's radius
/// there.
bool smoothlyOne(const CellPiece& a, const CellPiece& b, double radius);
/// A surface that bends from the one place to the other bends as much from either.
void takeBend(CellPiece& piece, const CellPiece& other);

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
    int labels[kMost] = {};  ///< of samples: which piece
    double depths[kMost] = {};
    int samples = 1;  ///< that have labels; the centre's first
    bool resolved = false;

    glm::dvec2 sampleAt(int i) const;
    /// Of the samples that see the piece the one nearest to their mean; kUnknown: none does.
    int sampleOf(int piece) const;
    /// Divides it by counting the labels at the standard locations.
    void divideByCount();
};

/// The standard location i of 16 within a pixel, moved by 1/32 px so that their mean is the centre.
glm::dvec2 countedPlace(const glm::dvec2& centre_px, int i);

/// Labels samples and divides pixels.
class EdgeCells {
  public:
    /// Refers to its arguments. `tracer`: of the scene, for distances between rays and solids; without it
    /// there are no outlines.
    EdgeCells(const sdf::RayGrid& grid, const sdf::SceneTracer* tracer) : grid_(grid), tracer_(tracer) {}

    /// The label of sample i at that depth; kUnknown where it is on none of the pieces.
    int labelOf(const EdgeCell& cell, int i, double depth) const;
    /// Divides the cell by lines, if what its samples see agrees with them.
    void divideByLines(EdgeCell& cell) const;

  private:
    sdf::FieldRay rayOf(const glm::dvec2& p_px) const { return grid_.ray(p_px); }
    bool divideByCrease(EdgeCell& cell, int a, int b) const;
    bool divideByOutline(EdgeCell& cell) const;
    bool divideByStrip(EdgeCell& cell) const;
    std::optional<sdf::FilmLine> outlineFrom(const glm::dvec2& p_px, double t) const;

    const sdf::RayGrid& grid_;
    const sdf::SceneTracer* tracer_;
};

}  // namespace edgewise
