// NSAA, Figure 1: one pixel, by samples and by the integral.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "paper_figures/flat_scene.h"
#include "pipeline/progress.h"

namespace edgewise::figures {

inline constexpr int kPixelFilm = 8;              ///< px, a side
inline constexpr glm::ivec2 kStudiedPixel{3, 3};  ///< its sample is at (3.5, 3.5)

/// What is measured is the first; the second one hides a part of it.
std::vector<FlatTriangle> pixelTriangles();

/// How much of the pixel a method gives to the first triangle.
struct PixelShare {
    std::string method, filter;
    double radius = 0.5;  ///< px
    double weight = 0.0;
};

/// Samplers by their own pixel, then nsaa with each kernel. Throws Interrupted when cancelled.
std::vector<PixelShare> pixelShares(Progress& progress);

/// The first triangle is what is seen at the point.
bool firstIsSeen(const std::vector<FlatTriangle>& triangles, glm::dvec2 p_px);

}  // namespace edgewise::figures
