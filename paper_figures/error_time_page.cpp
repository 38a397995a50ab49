#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "paper_figures/error_time.h"
#include "paper_figures/line_plot.h"
#include "paper_figures/page_parts.h"
#include "pipeline/compare/comparison_report.h"
#include "pipeline/compare/comparison_tables.h"
#include "pipeline/compare/pareto_plot.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/plot_colors.h"

namespace edgewise::figures {
namespace {

std::string wordsOf(SceneKind kind) {
    return kind == SceneKind::kField ? "SDF scenes" : "triangles";
}

/// Powers of two around all values and 1.
PlotAxis ratioAxis(const std::vector<double>& values, const std::string& title) {
    double low = 1.0, high = 1.0;
    for (const double v : values) low = std::min(low, v), high = std::max(high, v);
    return {std::exp2(std::floor(std::log2(low) - 0.25)), std::exp2(std::ceil(std::log2(high) + 0.25)), 0.0,
            title, true};
}

FigurePlot meansPlot(const ErrorTime& found, SceneKind kind) {
    const std::vector<MethodMean> means = methodMeans(found, kind);
    std::vector<double> times, errors;
    for (const MethodMean& mean : means) {
        times.push_back(mean.time_ratio);
        if (mean.error_ratio) errors.push_back(*mean.error_ratio);
    }
    LinePlot plot{.label = "Error against time, " + wordsOf(kind),
                  .x = ratioAxis(times, "time, in that of none"),
                  .y = ratioAxis(errors, "RMSE, in that of none"),
                  .marks = {},
                  .curves = {}};
    std::map<std::string, std::vector<glm::dvec2>> families;
    for (const MethodMean& mean : means)
        families[mean.family].emplace_back(mean.time_ratio, mean.error_ratio.value_or(plot.y.low));
    for (auto& [family, points] : families) {
        std::ranges::sort(points, {}, &glm::dvec2::x);
        const std::size_t i = plot.curves.size();
        plot.curves.push_back({family, kPlotColors[i % kPlotColors.size()], false, i >= kPlotColors.size(),
                               points.size() > 1 ? points : std::vector<glm::dvec2>(), points});
    }
    return {
        kind == SceneKind::kField ? "means-sdf" : "means-triangles",
        fmt::format("All {}: geometric means over scenes of time and RMSE in those of none. On the floor: "
                    "no error.",
                    wordsOf(kind)),
        linePlotSvg(plot)};
}

bool has(const ErrorTime& found, SceneKind kind) {
    return std::ranges::any_of(found.scenes, [&](const ErrorTimeScene& s) { return s.kind == kind; });
}

std::string meansTable(const ErrorTime& found) {
    std::string rows;
    for (const SceneKind kind : {SceneKind::kTriangles, SceneKind::kField})
        for (const MethodMean& mean : methodMeans(found, kind))
            rows += fmt::format(
                "<tr><td>{}</td><td>{}</td>{}{}{}{}</tr>\n", escapedHtml(mean.method), wordsOf(kind),
                numberCell(mean.scenes, "{:.0f}"), numberCell(mean.time_ratio, "{:.2f}"),
                mean.error_ratio ? numberCell(*mean.error_ratio, "{:.3f}") : sortedCell(0.0, "0"),
                sortedCell(static_cast<double>(mean.fronts),
                           fmt::format("{} of {}", mean.fronts, mean.scenes)));
    return cardTable(
        "<th>method</th><th>on</th><th>scenes</th><th>time, in none's</th><th>RMSE, in none's</th>"
        "<th>nothing is both faster and nearer</th>",
        rows);
}

std::string frontsTable(const ErrorTime& found) {
    std::string rows;
    for (const ErrorTimeScene& scene : found.scenes) {
        const auto& all = scene.comparison.rows;
        const std::vector<bool> front = onFront(all);
        std::vector<std::pair<double, std::string>> kept;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (front[i]) kept.emplace_back(compare::spreadOf(all[i].seconds).median, all[i].method);
        std::ranges::sort(kept);
        std::string names;
        for (const auto& [seconds, method] : kept) names += (names.empty() ? "" : ", ") + escapedHtml(method);
        rows += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escapedHtml(scene.comparison.scene), names);
    }
    return cardTable("<th>scene</th><th>methods that nothing beats in both, by time</th>", rows);
}

std::string rowsTable(const ErrorTime& found) {
    std::string rows;
    for (const ErrorTimeScene& scene : found.scenes)
        for (const compare::Row& row : scene.comparison.rows)
            rows += fmt::format("<tr><td>{}</td>{}</tr>\n", escapedHtml(scene.comparison.scene),
                                compare::reportCells(row));
    return "<details><summary>All rows</summary>\n" +
           cardTable("<th>scene</th>" + compare::reportHeads(), rows) +
           "</details>\n<h2>Definitions</h2><div class='card'>" + compare::reportDefinitions() + "</div>\n";
}

std::string notesHtml(const ErrorTime& found) {
    std::string out;
    for (const std::string& note : found.notes) out += fmt::format("<li>{}</li>\n", escapedHtml(note));
    return out.empty() ? ""
                       : "<h2>What could not be measured</h2><div class='card'><ul>" + out + "</ul></div>\n";
}

FigureWords wordsOf(const ErrorTime& found) {
    const compare::Machine machine = compare::thisMachine();
    std::string references;
    for (const ErrorTimeScene& scene : found.scenes)
        if (references.find(scene.comparison.reference) == std::string::npos)
            references +=
                (references.empty() ? "" : "; ") + wordsOf(scene.kind) + ": " + scene.comparison.reference;
    return {
        "error-time",
        "Error against run time",
        "Every method on every scene that ships. A row is a process of its own; methods take turns, times "
        "are "
        "medians without set-up. All filters are a pixel's box, so that methods with a box of their own are "
        "judged alike. nsaa is the reference of triangles and errs by nothing there but rounding; a "
        "reference of "
        "samples has an error of its own, which ends what can be told. path:4 follows all light, the others "
        "one "
        "bounce: its error is not aliasing alone. exact is left out: it is for small crops.",
        {{"references", references},
         {"filter", "box, R 0.5"},
         {"runs", fmt::format("{}, by turns, after one that does not count; at most {:.0f} s a method",
                              found.runs, found.budget_seconds)},
         {"machine", fmt::format("{}, {} cores", machine.processor, machine.cores)},
         {"time", fmt::format("{:.0f} s for all", found.seconds)},
         {"seed", "0"}},
        {"edgewise compare SCENE -o DIR --filter box --size WxH --reference R --method M ..."},
        found.quick};
}

}  // namespace

std::vector<FigurePlot> errorTimePlots(const ErrorTime& found) {
    std::vector<FigurePlot> plots;
    for (const SceneKind kind : {SceneKind::kTriangles, SceneKind::kField})
        if (has(found, kind)) plots.push_back(meansPlot(found, kind));
    for (const ErrorTimeScene& scene : found.scenes) {
        const auto& rows = scene.comparison.rows;
        plots.push_back(
            {"pareto-" + scene.comparison.scene,
             fmt::format("{}, {} x {}", scene.comparison.scene, rows.front().size.x, rows.front().size.y),
             compare::paretoSvg(scene.comparison)});
    }
    return plots;
}

std::string errorTimeHtml(const ErrorTime& found, const std::vector<FigurePlot>& plots) {
    return figurePage(wordsOf(found), plotsHtml(plots) + "<h2>Methods over all scenes</h2>" +
                                          meansTable(found) + "<h2>Scene by scene</h2>" + frontsTable(found) +
                                          rowsTable(found) + notesHtml(found));
}

std::string errorTimeCsv(const ErrorTime& found) {
    std::string out = "scene," + compare::csvColumns() + "\n";
    for (const ErrorTimeScene& scene : found.scenes)
        for (const compare::Row& row : scene.comparison.rows)
            out += compare::csvText(scene.comparison.scene) + "," + compare::csvFields(row) + "\n";
    return out;
}

std::string meansCsv(const ErrorTime& found) {
    std::string out = "on,method,scenes,time_ratio,rmse_ratio,fronts\n";
    for (const SceneKind kind : {SceneKind::kTriangles, SceneKind::kField})
        for (const MethodMean& mean : methodMeans(found, kind))
            out += fmt::format("{},{},{},{},{},{}\n", wordsOf(kind), compare::csvText(mean.method),
                               mean.scenes, mean.time_ratio, mean.error_ratio.value_or(0.0), mean.fronts);
    return out;
}

}  // namespace edgewise::figures
