// Directed edges that are hard for the terms of prefilters, in nine categories. Ends are relative to the
// sample, on the scene's grid of 2^-32 px, so that they and the sample's distances are exact.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "analytic/edge_integral.h"
#include "tests/witness/dice.h"

namespace edgewise::study {

struct Edge {
    glm::dvec2 a, b;
};

enum class Category {
    kThroughSample,   ///< the line passes through the sample, or by it in down to 2^-45 R
    kVertexAtSample,  ///< an end on the sample, or in down to 2^-45 R
    kTangent,         ///< runs along the support's border, or crosses it flatly; separable: by corners too
    kFarAndLong,      ///< up to 2^18 px long
    kTiny,            ///< down to one step of the grid, anywhere in the support
    kNearRadial,      ///< points at the sample, from one side
    kAxisParallel,    ///< horizontal or vertical, exactly or nearly; half of them along a knot
    kEndOnBorder,     ///< an end on the border or a step of the grid beside it
    kEndOnKnot        ///< an end where two of the kernel's knots cross; radial: on a ring
};
inline constexpr int kCategories = 9;
const char* nameOf(Category category);

/// What of a kernel makes an edge hard.
struct HardSpots {
    explicit HardSpots(const EdgeKernel& kernel, const Prefilter& filter);

    double R;
    bool radial;
    /// Separable: where k changes its polynomial. Radial: radii where the evaluation changes its form, and
    /// sigmas.
    std::vector<double> knots;
};

/// A new edge of the category; its ends differ.
Edge makeEdge(Category category, const HardSpots& spots, witness::Dice& dice);

/// Whether it meets the category's hard spot to 2^-15 of its scale: judged from the edge, not from its
/// making.
bool isHard(Category category, const HardSpots& spots, const Edge& edge);

/// Rounds to the grid.
glm::dvec2 onGrid(glm::dvec2 p);

/// 2^-uniform(from, to).
double smallNumber(witness::Dice& dice, double from, double to);

}  // namespace edgewise::study
