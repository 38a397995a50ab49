// Triangle methods and SDF methods on the same geometry: error against run time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure.h"
#include "paper_figures/figure_plot.h"
#include "pipeline/compare/comparison.h"

namespace edgewise::figures {

struct SharedGeometry {
    bool quick = false;
    int runs = 0;
    double seconds = 0.0;  ///< that all of it took
    std::string reference;
    std::vector<compare::Comparison> scenes;
    std::vector<std::string> notes;  ///< what could not be measured, one sentence each
};

/// An .sdf.json without its half-spaces and shadows: what is left has edges of geometry alone. Menger's
/// sponge is turned back to the axes, where its mesh is exact. Throws InputError for what is no such scene.
std::string bareScene(const std::string& json, const std::string& source);

/// How many samples a pixel ssaa needs for a method's error, by log-log interpolation between its rows; none
/// where the error is outside of what they have.
std::optional<double> samplesFor(double rmse, const std::vector<compare::Row>& rows);

/// What the papers say of their methods, and what is found here.
void addSharedClaims(const SharedGeometry& found, std::vector<FigureClaim>& claims);

std::vector<FigurePlot> sharedGeometryPlots(const SharedGeometry& found);
std::string sharedGeometryHtml(const SharedGeometry& found, const std::vector<FigurePlot>& plots);
/// A line a scene and method: what compare has of a row, the reference's own error, antialiasing alone, the
/// mesh's triangles and error.
std::string sharedGeometryCsv(const SharedGeometry& found);

}  // namespace edgewise::figures
