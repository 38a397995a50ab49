#include "paper_figures/stability_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "paper_figures/line_plot.h"
#include "paper_figures/value_grid.h"
#include "pipeline/judge/stability_cases.h"
#include "pipeline/plot_colors.h"

namespace edgewise::figures {
namespace {

using Rows = std::vector<judge::StabilityRow>;

constexpr double kPaleOfBound = 1e-4;  ///< and below

GridCell cellOf(double of_bound, bool kept) {
    const double shade = of_bound <= 0.0 ? 0.0 : 1.0 - std::log10(of_bound) / std::log10(kPaleOfBound);
    return {of_bound == 0.0   ? "0"
            : of_bound < 1e-9 ? "< 1e-9"
                              : fmt::format("{:.2g}", of_bound),
            shade, of_bound > 1.0 || !kept};
}

/// In order of appearance.
std::vector<std::string> namesOf(const std::vector<AtlasCell>& cells, std::string AtlasCell::*name) {
    std::vector<std::string> names;
    for (const AtlasCell& cell : cells)
        if (std::ranges::find(names, cell.*name) == names.end()) names.push_back(cell.*name);
    return names;
}

struct Points {
    std::vector<glm::dvec2> error, float_error, bound, float_bound;
};

std::map<std::string, Points> pointsOf(const Rows& rows, const std::string& case_name) {
    std::map<std::string, Points> by_filter;
    for (const judge::StabilityRow& r : rows) {
        if (r.case_name != case_name) continue;
        Points& own = by_filter[r.filter];
        own.error.emplace_back(r.condition, r.max_error);
        own.float_error.emplace_back(r.condition, r.fp32.max_error);
        own.bound.emplace_back(r.condition, r.bound);
        own.float_bound.emplace_back(r.condition, r.fp32.bound);
    }
    for (auto& [filter, points] : by_filter)
        for (auto* part : {&points.error, &points.float_error, &points.bound, &points.float_bound})
            std::ranges::sort(*part, {}, &glm::dvec2::x);
    return by_filter;
}

double decade(double value, bool up) {
    const double e = std::log10(value);
    return std::pow(10.0, up ? std::ceil(e) : std::floor(e));
}

FigurePlot casePlot(const judge::StabilityCase& one, const std::map<std::string, Points>& by_filter) {
    constexpr double kLeast = 1e-19, kMost = 1e-4;
    double low = HUGE_VAL, high = 0.0, top = kMost;
    std::map<double, double> bound, float_bound;  // the largest of all filters
    for (const auto& [filter, points] : by_filter)
        for (std::size_t i = 0; i < points.error.size(); ++i) {
            const double x = points.error[i].x;
            low = std::min(low, x), high = std::max(high, x);
            bound[x] = std::max(bound[x], points.bound[i].y);
            float_bound[x] = std::max(float_bound[x], points.float_bound[i].y);
            top = std::max({top, points.error[i].y, points.float_error[i].y});
        }
    LinePlot plot{.label = one.name + ": error against " + one.condition,
                  .x = {decade(low, false), std::max(decade(high, true), 10.0 * decade(low, false)), 0.0,
                        one.condition, true},
                  .y = {kLeast, decade(top, true), 0.0, "largest error of a weight", true},
                  .marks = {},
                  .curves = {}};
    const auto add = [&](const std::string& name, const char* color, bool hollow,
                         std::vector<glm::dvec2> points) {
        for (glm::dvec2& p : points) p.y = std::max(p.y, kLeast);
        plot.curves.push_back({name, color, false, hollow, points, points});
    };
    std::size_t i = 0;
    for (const auto& [filter, points] : by_filter) {
        const char* color = kPlotColors[i++ % kPlotColors.size()];
        add(filter, color, false, points.error);
        add(filter + ", fp32", color, true, points.float_error);
    }
    const auto addBound = [&](const std::string& name, const char* color,
                              const std::map<double, double>& values) {
        PlotCurve curve{name, color, true, false, {}, {}};
        for (const auto& [x, y] : values) curve.line.emplace_back(x, y);
        plot.curves.push_back(std::move(curve));
    };
    addBound("promised", "#444444", bound), addBound("promised, fp32", "#aaaaaa", float_bound);
    return {"case-" + one.name, one.name + ": " + one.what, linePlotSvg(plot)};
}

}  // namespace

std::vector<AtlasCell> atlasCells(const Rows& rows) {
    std::vector<AtlasCell> cells;
    for (const judge::StabilityRow& r : rows) {
        auto cell = std::ranges::find_if(
            cells, [&](const AtlasCell& c) { return c.case_name == r.case_name && c.filter == r.filter; });
        if (cell == cells.end()) cell = cells.insert(cells.end(), AtlasCell{r.case_name, r.filter});
        if (r.worst_of_bound >= cell->of_bound) cell->of_bound = r.worst_of_bound, cell->at = r.condition;
        cell->of_float_bound = std::max(cell->of_float_bound, r.fp32.worst_of_bound);
        cell->max_error = std::max(cell->max_error, r.max_error);
        cell->max_float_error = std::max(cell->max_float_error, r.fp32.max_error);
        cell->ownership_errors += r.ownership_errors + r.fp32.ownership_errors;
        if (r.map) cell->ownership_errors += r.map->ownership_errors;
        cell->kept = cell->kept && judge::keepsPromises(r);
    }
    return cells;
}

FigurePlot atlasPlot(const std::vector<AtlasCell>& cells) {
    ValueGrid grid{
        "Errors over their bounds, by case and filter", namesOf(cells, &AtlasCell::case_name), {}, {}};
    const auto filters = namesOf(cells, &AtlasCell::filter);
    for (const std::string& filter : filters) grid.columns.push_back(filter), grid.columns.push_back("fp32");
    grid.cells.resize(grid.rows.size() * grid.columns.size());
    for (const AtlasCell& cell : cells) {
        const auto row = std::ranges::find(grid.rows, cell.case_name) - grid.rows.begin(),
                   column = 2 * (std::ranges::find(filters, cell.filter) - filters.begin());
        const std::size_t at =
            static_cast<std::size_t>(row) * grid.columns.size() + static_cast<std::size_t>(column);
        grid.cells[at] = cellOf(cell.of_bound, cell.kept),
        grid.cells[at + 1] = cellOf(cell.of_float_bound, cell.kept);
    }
    return {
        "atlas",
        "The largest error of a weight over what is promised for it, the worst of all difficulties. Red: a "
        "promise is broken.",
        valueGridSvg(grid)};
}

std::vector<FigurePlot> stabilityPlots(const Rows& rows) {
    std::vector<FigurePlot> plots;
    for (const judge::StabilityCase& one : judge::stabilityCases()) {
        const auto by_filter = pointsOf(rows, one.name);
        if (!by_filter.empty()) plots.push_back(casePlot(one, by_filter));
    }
    return plots;
}

}  // namespace edgewise::figures
