// The stability study as a figure: the same rows as `edgewise stability`.
#include <fmt/format.h>

#include <algorithm>

#include "paper_figures/page_parts.h"
#include "paper_figures/stability_atlas.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/judge/stability_cases.h"
#include "pipeline/judge/stability_report.h"

namespace edgewise::figures {
namespace {

judge::StabilityOptions optionsFor(bool quick) {
    judge::StabilityOptions options;
    for (const char* name : {"box", "cone", "gaussian", "mitchell"}) {
        if (quick && name != std::string("box") && name != std::string("gaussian")) continue;
        options.filters.push_back(makePrefilter(name, {}, {}));
    }
    if (quick) options.scenes = 1, options.every = 8;
    return options;
}

std::string summary(const std::vector<judge::StabilityRow>& rows, const std::vector<AtlasCell>& cells) {
    std::size_t weights = 0;
    for (const judge::StabilityRow& row : rows) weights += row.weights;
    const auto broken = std::ranges::count(cells, false, &AtlasCell::kept);
    return fmt::format(
        "<p>{} weights of {} rows judged against exact arithmetic; {} <a href='stability.html'>All rows, "
        "maps and "
        "projections</a>.</p>\n",
        weights, rows.size(),
        broken == 0 ? "every one lies within its bound, with the oracle's owners."
                    : fmt::format("<b>{} of {} (case, filter) break a promise.</b>", broken, cells.size()));
}

std::string cellsTable(const std::vector<AtlasCell>& cells) {
    std::string rows;
    for (const AtlasCell& c : cells)
        rows += fmt::format("<tr><td>{}</td><td>{}</td>", escapedHtml(c.case_name), escapedHtml(c.filter)) +
                numberCell(c.max_error, "{:.2e}") + numberCell(c.of_bound, "{:.3g}") +
                numberCell(c.at, "{:.3g}") + numberCell(c.max_float_error, "{:.2e}") +
                numberCell(c.of_float_bound, "{:.3g}") +
                numberCell(static_cast<double>(c.ownership_errors), "{:.0f}") +
                fmt::format("<td>{}</td></tr>\n", c.kept ? "kept" : "broken");
    return cardTable(
        "<th>case</th><th>filter</th><th>largest error</th><th>of its bound</th><th>at</th><th>fp32, largest "
        "error</th><th>of its bound</th><th>wrong owners</th><th>promises</th>",
        rows);
}

}  // namespace

std::vector<FigureFile> makeStability(const FigureInput& input) {
    const judge::StabilityOptions options = optionsFor(input.quick);
    const auto rows = judge::runStability(options, input.progress);
    const std::vector<AtlasCell> cells = atlasCells(rows);
    std::vector<FigurePlot> plots{atlasPlot(cells)};
    for (FigurePlot& plot : stabilityPlots(rows)) plots.push_back(std::move(plot));
    const std::string command = fmt::format("edgewise stability -o DIR --scenes {}", options.scenes);
    FigureWords words{
        "stability",
        "Stability atlas",
        "Stiff and extreme scenes, each swept over how difficult it is. A row is several random scenes; an "
        "error "
        "is the largest of all weights of a pixel against exact arithmetic, its bound what is promised for "
        "as "
        "many terms (fp32: 64 times 2^-24). Dots on the floor: no error that numbers of this size have.",
        {{"cases", fmt::format("{}", judge::stabilityCases().size())},
         {"scenes a difficulty", fmt::format("{}", options.scenes)},
         {"difficulties", options.every == 1 ? "all" : fmt::format("one of {}", options.every)},
         {"seed", "by case, difficulty and scene"}},
        {command},
        input.quick};
    std::vector<FigureFile> files{
        {"report.html", figurePage(words, summary(rows, cells) + "<div style='max-width:900px'>" +
                                              plotsHtml(std::span(plots).first(1)) + "</div>" +
                                              plotsHtml(std::span(plots).subspan(1)) +
                                              "<h2>The worst of each</h2>" + cellsTable(cells))},
        {"results.csv", judge::stabilityCsv(rows)},
        {"table.tex", judge::stabilityLatex(rows)},
        {"stability.html", judge::stabilityHtml(rows, command)}};
    appendPlotFiles(plots, files);
    return files;
}

}  // namespace edgewise::figures
