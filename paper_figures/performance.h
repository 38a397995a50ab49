// What the performance page measures, and the forms in which it shows it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paper_figures/figure.h"
#include "paper_figures/figure_plot.h"
#include "paper_figures/machine_rates.h"
#include "paper_figures/power_fit.h"
#include "pipeline/compare/comparison.h"

namespace edgewise::figures {

/// A scene, its filter, and the samplers whose time nsaa has to stay below.
struct PerformanceScene {
    std::string name, title;  ///< title: the name, and the filter where it is not the box
    std::string filter;
    double radius = 0.5;
    int width = 0, height = 0;
    std::string at_most, aim;  ///< methods
    std::string remark;        ///< of the table of bars
};

struct SceneTimes {
    PerformanceScene scene;
    compare::Comparison comparison;
};

struct GrowthPoint {
    double x = 0.0;    ///< triangles, or pixels a side
    compare::Row row;  ///< box filter; without errors
};

struct GrowthSeries {
    std::string family, method;  ///< "torus", "nsaa"
    bool by_triangles = true;
    std::vector<GrowthPoint> points;  ///< by ascending x, each with a time
};

struct Performance {
    bool quick = false;
    int runs = 0;
    compare::Machine machine;
    MachineRates rates;
    std::vector<SceneTimes> scenes;
    std::vector<GrowthSeries> growth;
    std::vector<std::string> notes;  ///< what could not be measured, one sentence each
};

/// nullptr where the method has no row.
const compare::Row* rowOf(const SceneTimes& times, const std::string& method);

/// nsaa's median against a peer's of the same run.
struct Bar {
    std::string peer;
    std::optional<double> seconds;  ///< the peer's median; none where it could not run
    std::optional<double> ratio;    ///< nsaa's over the peer's
    bool met() const { return ratio && *ratio <= 1.0; }
};

struct BarRow {
    const SceneTimes* times;
    std::optional<double> nsaa_seconds;
    Bar at_most, aim;
};

/// A row a scene, in their order; refers to them.
std::vector<BarRow> barRows(const Performance& performance);

/// The median of a stage, or of all of them together ("total"), at each point; zeros are left out.
std::vector<glm::dvec2> growthPoints(const GrowthSeries& series, const std::string& stage);

/// The stages of nsaa as they run.
const std::vector<std::string>& nsaaStages();

/// Names of the rows of GrowthSeries that a table shows: "total", and for nsaa its stages.
std::vector<std::string> shownStages(const GrowthSeries& series);

std::vector<FigurePlot> performancePlots(const Performance& performance);

std::string performanceJson(const Performance& performance);
/// Every row of every scene: the scene's title and what compare has of a row.
std::string performanceCsv(const Performance& performance);
std::string barsCsv(const Performance& performance);
std::string growthCsv(const Performance& performance);
std::string stagesCsv(const Performance& performance);
/// The table of bars.
std::string barsLatex(const Performance& performance);

std::string performanceHtml(const Performance& performance, const std::vector<FigurePlot>& plots);

}  // namespace edgewise::figures
