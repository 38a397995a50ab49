#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "paper_figures/filter_study.h"
#include "paper_figures/line_plot.h"
#include "pipeline/plot_colors.h"

namespace edgewise::figures {
namespace {

constexpr int kMeasuredEvery = 20;  ///< a dot each so many steps of the curve

double decibels(double amplitude) {
    return 20 * std::log10(std::max(std::abs(amplitude), 1e-12));
}

struct Shown {
    const FilterStudy& study;
    std::function<bool(const FilterRow&)> picked;
    bool with_radius;

    std::vector<PlotCurve> curves(const std::function<void(const FilterRow&, PlotCurve&)>& fill) const {
        std::vector<PlotCurve> out;
        for (const FilterRow& row : study.rows) {
            if (!picked(row)) continue;
            PlotCurve curve{with_radius ? titleOf(row.filter) : row.filter.name,
                            colorOf(study, row.filter),
                            !row.filter.radial(),
                            !row.paper_radius,
                            {},
                            {}};
            fill(row, curve);
            out.push_back(std::move(curve));
        }
        return out;
    }
};

std::string responseSvg(const Shown& shown, bool diagonal, const std::string& label) {
    LinePlot plot{.label = label,
                  .x = {0, kShownFrequency, 0.25, "frequency, cycles/px"},
                  .y = {-100, 10, 10, "response, dB"},
                  .marks = {{kNyquist, "Nyquist"}},
                  .curves = {}};
    if (diagonal) plot.marks = {{kNyquist * M_SQRT2, "Nyquist, diagonal"}};
    plot.curves = shown.curves([&](const FilterRow& row, PlotCurve& curve) {
        const AlongDirection& along = diagonal ? row.diagonal : row.axis;
        for (int i = 0; i <= kShownSteps; ++i) {
            const double f = kShownFrequency * i / kShownSteps;
            curve.line.emplace_back(f, decibels(along.response[i]));
            if (i % kMeasuredEvery == 0) curve.dots.emplace_back(f, decibels(along.measured[i]));
        }
    });
    return linePlotSvg(plot);
}

std::string stepSvg(const Shown& shown) {
    LinePlot plot{.label = "step response along the axis",
                  .x = {-kShownReach, kShownReach, 1, "distance of the edge from the sample, px"},
                  .y = {-0.2, 1.2, 0.1, "step response"},
                  .marks = {},
                  .curves = {}};
    plot.curves = shown.curves([](const FilterRow& row, PlotCurve& curve) {
        for (int i = 0; i <= kShownSteps; ++i)
            curve.line.emplace_back(kShownReach * (2.0 * i / kShownSteps - 1), row.axis.step[i]);
    });
    return linePlotSvg(plot);
}

/// Both in decibels of what an unfiltered edge has beyond Nyquist: 1/(2 pi^2 N) with N = 1/2, 1/pi^2 px.
std::string tradeSvg(const Shown& shown) {
    const auto of = [](double energy_px) { return 10 * std::log10(energy_px * M_PI * M_PI); };
    LinePlot plot{.label = "aliasing against blur of an edge",
                  .x = {-20, 5, 5, "blur, dB of what an unfiltered edge has beyond Nyquist"},
                  .y = {-45, -5, 5, "aliasing, dB of the same"},
                  .marks = {},
                  .curves = {}};
    plot.curves = shown.curves([&](const FilterRow& row, PlotCurve& curve) {
        curve.dots.emplace_back(of(row.mean_edge.blur), of(row.mean_edge.aliasing));
    });
    return linePlotSvg(plot);
}

}  // namespace

std::string colorOf(const FilterStudy& study, const Prefilter& filter) {
    std::set<std::string> before;
    for (const FilterRow& row : study.rows) {
        if (row.filter.name == filter.name) break;
        before.insert(row.filter.name);
    }
    return kPlotColors[before.size() % kPlotColors.size()];
}

std::vector<FigurePlot> filterFigurePlots(const FilterStudy& study) {
    const Shown paper{study, [](const FilterRow& row) { return row.paper_radius; }, false};
    const Shown own{study, [](const FilterRow& row) { return !row.paper_radius; }, true};
    const Shown all{study, [](const FilterRow&) { return true; }, true};
    std::vector<FigurePlot> plots{
        {"response-axis",
         "Frequency response along the axis, R 2. Lines: the kernel's transform. Dots: from a slanted edge "
         "that "
         "nsaa rendered.",
         responseSvg(paper, false, "frequency response along the axis")},
        {"response-diagonal",
         "The same along the diagonal: radial filters (solid) have one curve for all directions, separable "
         "ones "
         "(dashed) do not.",
         responseSvg(paper, true, "frequency response along the diagonal")},
        {"step", "Step response along the axis, R 2: what goes below 0 or above 1 rings.", stepSvg(paper)},
        {"trade-off",
         "A sampled edge, mean over all orientations: what is false in it against what is lost. Lower left "
         "is "
         "better. Hollow: the default radii.",
         tradeSvg(all)}};
    if (std::ranges::any_of(study.rows, own.picked))
        plots.push_back({"response-own-radius", "Frequency response along the axis at the default radii.",
                         responseSvg(own, false, "frequency response at the default radii")});
    return plots;
}

}  // namespace edgewise::figures
