#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper_figures/line_plot.h"
#include "paper_figures/performance.h"
#include "paper_figures/stacked_bars.h"
#include "pipeline/compare/pareto_plot.h"
#include "pipeline/plot_colors.h"

namespace edgewise::figures {
namespace {

constexpr double kMilliseconds = 1e3;

/// The decades' digits 1, 2, 5 around all values.
PlotAxis axisAround(const std::vector<double>& values, const std::string& title) {
    const auto [least, most] = std::ranges::minmax(values);
    const auto rounded = [](double value, bool up) {
        const double decade = std::pow(10.0, std::floor(std::log10(value)));
        double best = up ? 10 * decade : decade;
        for (const double digit : {1.0, 2.0, 5.0})
            if (up ? digit * decade >= value && digit * decade < best
                   : digit * decade <= value && digit * decade > best)
                best = digit * decade;
        return best;
    };
    const double low = rounded(least, false);
    return {low, std::max(rounded(most, true), 2 * low), 0.0, title, true};
}

/// Dots where it was measured, a line where the fit is.
PlotCurve curveOf(const GrowthSeries& series, const std::string& stage, const std::string& name,
                  std::size_t color) {
    PlotCurve curve{name, kPlotColors[color % kPlotColors.size()], series.method != "nsaa", false, {}, {}};
    const auto points = growthPoints(series, stage);
    for (const glm::dvec2& p : points) curve.dots.emplace_back(p.x, kMilliseconds * p.y);
    if (const auto fit = fitPower(points))
        for (const glm::dvec2& p : points) curve.line.emplace_back(p.x, kMilliseconds * fit->at(p.x));
    return curve;
}

FigurePlot growthPlot(const std::string& name, const std::string& caption, bool by_triangles,
                      std::vector<PlotCurve> curves) {
    std::vector<double> x, y;
    for (const PlotCurve& curve : curves)
        for (const glm::dvec2& p : curve.dots) x.push_back(p.x), y.push_back(p.y);
    LinePlot plot{.label = name,
                  .x = axisAround(x, by_triangles ? "triangles" : "pixels a side"),
                  .y = axisAround(y, "milliseconds, median"),
                  .marks = {},
                  .curves = std::move(curves)};
    return {name, caption, linePlotSvg(plot)};
}

void appendTotals(const Performance& found, bool by_triangles, std::vector<FigurePlot>& plots) {
    std::vector<PlotCurve> curves;
    for (const GrowthSeries& series : found.growth)
        if (series.by_triangles == by_triangles && !series.points.empty())
            curves.push_back(curveOf(series, "total", series.family + ", " + series.method, curves.size()));
    if (curves.empty()) return;
    const std::string name = by_triangles ? "growth-triangles" : "growth-resolution";
    const std::string caption =
        by_triangles ? "Time against triangles at a fixed size. " : "Time against the pixels of a side. ";
    plots.push_back(growthPlot(name, caption + "Dots: medians. Lines: power laws through them.", by_triangles,
                               std::move(curves)));
}

void appendStages(const Performance& found, std::vector<FigurePlot>& plots) {
    for (const GrowthSeries& series : found.growth) {
        if (series.method != "nsaa" || series.points.empty()) continue;
        std::vector<PlotCurve> curves;
        for (const std::string& stage : shownStages(series))
            curves.push_back(curveOf(series, stage, stage, curves.size()));
        std::erase_if(curves, [](const PlotCurve& curve) { return curve.dots.empty(); });
        plots.push_back(growthPlot(
            fmt::format("growth-{}-{}", series.by_triangles ? "triangles" : "resolution", series.family),
            fmt::format("The stages of nsaa, {}.", series.family), series.by_triangles, std::move(curves)));
    }
}

FigurePlot sharesPlot(const Performance& found) {
    StackedBars plot{"share of the stages", nsaaStages(), {}};
    for (const SceneTimes& times : found.scenes) {
        const compare::Row* nsaa = rowOf(times, "nsaa");
        if (!nsaa || nsaa->seconds.empty()) continue;
        StackedBar bar{times.scene.title, {}, ""};
        for (const std::string& stage : nsaaStages()) {
            const auto seconds = nsaa->stages.find(stage);
            bar.parts.push_back(seconds == nsaa->stages.end() ? 0.0
                                                              : compare::spreadOf(seconds->second).median);
        }
        bar.note = fmt::format("{:.3g} ms", kMilliseconds * compare::spreadOf(nsaa->seconds).median);
        plot.bars.push_back(std::move(bar));
    }
    return {"stages", "Share of nsaa's stages, percent, and its time.", stackedBarsSvg(plot)};
}

/// As part of a file's name.
std::string fileName(std::string text) {
    std::erase(text, ',');
    std::ranges::replace(text, ' ', '-');
    return text;
}

}  // namespace

std::vector<FigurePlot> performancePlots(const Performance& found) {
    std::vector<FigurePlot> plots;
    for (const SceneTimes& times : found.scenes)
        plots.push_back({"pareto-" + fileName(times.scene.title),
                         fmt::format("{}, {} x {}", times.scene.title, times.scene.width, times.scene.height),
                         compare::paretoSvg(times.comparison)});
    appendTotals(found, true, plots);
    appendTotals(found, false, plots);
    appendStages(found, plots);
    plots.push_back(sharesPlot(found));
    return plots;
}

}  // namespace edgewise::figures
