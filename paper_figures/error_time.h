// Error against run time of every method on every scene that ships.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure.h"
#include "paper_figures/figure_plot.h"
#include "pipeline/compare/comparison.h"

namespace edgewise::figures {

enum class SceneKind { kTriangles, kField };

struct ErrorTimeScene {
    SceneKind kind = SceneKind::kTriangles;
    compare::Comparison comparison;
};

struct ErrorTime {
    bool quick = false;
    int runs = 0;
    double budget_seconds = 0.0;  ///< a method and scene
    double seconds = 0.0;         ///< that all of it took
    std::vector<ErrorTimeScene> scenes;
    std::vector<std::string> notes;  ///< what could not be measured, one sentence each
};

/// By row: whether no other row has both less error and less time; never where either is unknown.
std::vector<bool> onFront(const std::vector<compare::Row>& rows);

/// A method over all scenes of one kind where it and `none` ran, as multiples of none's.
struct MethodMean {
    std::string method, family;
    std::size_t scenes = 0, fronts = 0;
    double time_ratio = 0.0;            ///< geometric mean
    std::optional<double> error_ratio;  ///< geometric mean where both err; none where it never errs
};

/// In the rows' order.
std::vector<MethodMean> methodMeans(const ErrorTime& found, SceneKind kind);

std::vector<FigurePlot> errorTimePlots(const ErrorTime& found);
std::string errorTimeHtml(const ErrorTime& found, const std::vector<FigurePlot>& plots);
/// A line a scene and method: what compare has of a row.
std::string errorTimeCsv(const ErrorTime& found);
std::string meansCsv(const ErrorTime& found);

}  // namespace edgewise::figures
