#include <fmt/format.h>

#include <algorithm>

#include "paper_figures/performance.h"
#include "paper_figures/stage_ideals.h"
#include "pipeline/compare/comparison_report.h"
#include "pipeline/compare/report_page.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

constexpr const char* kStyle = R"css(
.met{color:#2c6e35;font-weight:600}.missed{color:#b3261e;font-weight:600}
.plots{grid-template-columns:repeat(auto-fit,minmax(600px,1fr))}
.plots .card svg{max-width:820px}
.counts th{white-space:normal;min-width:52px;line-height:1.25}.counts{font-size:12px}
td.words{white-space:normal;text-align:left;min-width:320px}th.words{text-align:left}
td:nth-child(2),th:nth-child(2){text-align:right}.second td:nth-child(2),.second th:nth-child(2){text-align:left}
.scroll+p{margin-top:8px}p.under{font-size:13px;color:#444;margin:8px 0 0}
)css";

std::optional<double> milliseconds(const std::optional<double>& seconds) {
    return seconds ? std::optional(1e3 * *seconds) : std::nullopt;
}

std::string barCells(const Bar& bar) {
    return "<td>" + escapedHtml(bar.peer) + "</td>" + numberCell(milliseconds(bar.seconds), "{:.1f}") +
           numberCell(bar.ratio, "{:.2f}") +
           (!bar.ratio ? "<td></td>" : fmt::format("<td class='{0}'>{0}</td>", bar.met() ? "met" : "missed"));
}

std::string barsTable(const Performance& found) {
    std::string rows;
    for (const BarRow& row : barRows(found))
        rows += fmt::format("<tr><td>{}</td>{}{}{}<td class='words'>{}</td></tr>\n",
                            escapedHtml(row.times->scene.title),
                            numberCell(milliseconds(row.nsaa_seconds), "{:.1f}"), barCells(row.at_most),
                            barCells(row.aim), escapedHtml(row.times->scene.remark));
    return cardTable(
        "<th>scene</th><th>nsaa, ms</th><th>bar</th><th>ms</th><th>ratio</th><th></th><th>aim</th><th>ms</th>"
        "<th>ratio</th><th></th><th class='words'></th>",
        rows);
}

std::string summary(const Performance& found) {
    const std::vector<BarRow> rows = barRows(found);
    const auto met = [&](auto part) {
        return std::ranges::count_if(rows, [&](const BarRow& row) { return (row.*part).met(); });
    };
    return fmt::format(
        "<p>nsaa takes no longer than the sampler of its bar on <b>{} of {}</b> scenes, and than that of its "
        "aim on <b>{}</b>; a ratio is nsaa's median over the sampler's, of {} interleaved run{}.</p>\n",
        met(&BarRow::at_most), rows.size(), met(&BarRow::aim), found.runs, found.runs == 1 ? "" : "s");
}

std::string fitText(const std::optional<PowerFit>& fit) {
    if (!fit) return emptyCell() + "<td></td>";
    return fmt::format("<td data-value='{0}'>{0:.2f}{1}</td><td>{2:.2f} &ndash; {3:.2f}</td>", fit->exponent,
                       fit->standard_error ? fmt::format(" &plusmn; {:.2f}", *fit->standard_error) : "",
                       fit->least_local, fit->most_local);
}

std::string growthTable(const Performance& found) {
    std::string rows;
    for (const GrowthSeries& series : found.growth)
        for (const std::string& stage : shownStages(series)) {
            const auto points = growthPoints(series, stage);
            if (points.empty()) continue;
            rows += fmt::format(
                "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td>{}{}{}</tr>\n", escapedHtml(series.family),
                series.by_triangles ? "triangles" : "pixels a side", escapedHtml(series.method), stage,
                fitText(fitPower(points)), numberCell(1e3 * points.front().y, "{:.3g}"),
                numberCell(1e3 * points.back().y, "{:.3g}"));
        }
    return cardTable(
        "<th>scene</th><th>grows with</th><th>method</th><th>stage</th><th>exponent</th><th>between "
        "neighbours</th><th>first, ms</th><th>last, ms</th>",
        rows, "second");
}

constexpr const char* kGrowthWords =
    "<p class='under'>Exponents by least squares over logarithms, with the standard error of the slope; "
    "between neighbours: the least and the greatest of two points alone. What to expect: with triangles, "
    "project and plan touch each one, exponent 1; gather, visibility and weights follow the (cell, triangle) "
    "pairs and the length of visible edges, which for n triangles over a fixed area is like n<sup>1/2</sup> "
    "px until triangles are as small as pixels and like n beyond; blend follows the pixels, 0, until pixels "
    "hold many owners. With the pixels of a side, project and plan stay, 0; visibility and weights follow "
    "edges, 1, and as far as they touch every row or pixel 2; blend touches each pixel, 2.</p>";

std::string unitsTable(const Performance& found) {
    std::string heads = "<th>scene</th><th>nsaa, MiB</th>", rows;
    for (const SceneTimes& times : found.scenes) {
        const compare::Row* nsaa = rowOf(times, "nsaa");
        if (!nsaa || nsaa->seconds.empty()) continue;
        std::string line = fmt::format("<tr><td>{}</td>{}", escapedHtml(times.scene.title),
                                       numberCell(nsaa->peak_mib, "{:.0f}"));
        const bool first = rows.empty();
        for (const UnitCost& unit : unitCosts(*nsaa)) {
            if (first)
                heads += fmt::format("<th>{}s</th><th>ns a {}, {}</th>", unit.title, unit.title, unit.stage);
            line += numberCell(unit.number, "{:.0f}") + numberCell(unit.nanoseconds, "{:.1f}");
        }
        rows += line + "</tr>\n";
    }
    return cardTable(heads, rows, "counts");
}

std::string distanceTable(const Performance& found) {
    std::string rows;
    for (const SceneTimes& times : found.scenes) {
        const compare::Row* nsaa = rowOf(times, "nsaa");
        if (!nsaa || nsaa->seconds.empty()) continue;
        for (const StageDistance& d : stageDistances(*nsaa, found.rates))
            rows += fmt::format(
                "<tr><td>{}</td><td>{}</td>{}{}{}{}<td>{}</td>{}</tr>\n", escapedHtml(times.scene.title),
                d.stage, numberCell(1e3 * d.seconds, "{:.2f}"), numberCell(d.bytes / 0x1p20, "{:.2f}"),
                numberCell(1e-6 * d.flops, "{:.2f}"), numberCell(1e3 * d.ideal_seconds, "{:.3f}"),
                d.memory_bound ? "bytes" : "arithmetic", numberCell(d.distance(), "{:.1f}"));
    }
    return cardTable(
        "<th>scene</th><th>stage</th><th>measured, ms</th><th>moves, MiB</th><th>computes, "
        "Mflop</th><th>ideal, ms</th><th>bound by</th><th>times the ideal</th>",
        rows, "second");
}

std::string modelTable(const std::string& filter, double radius) {
    std::string rows;
    for (const StageModel& model : stageModels(filter, radius))
        for (const IdealPart& part : model.parts)
            rows += fmt::format("<tr><td>{}</td><td>{}</td>{}{}<td class='words'>{}</td></tr>\n", model.stage,
                                part.count, numberCell(part.bytes, "{:.0f}"),
                                numberCell(part.flops, "{:.0f}"), escapedHtml(part.words));
    return cardTable(
        "<th>stage</th><th>each</th><th>bytes</th><th>flops</th><th class='words'>what these are</th>", rows,
        "second");
}

std::string ratesText(const MachineRates& rates) {
    return fmt::format(
        "<p class='under'>Measured in this run, all threads: {:.2f} GB/s moved by a[i] = b[i] + s c[i] (24 "
        "bytes an element, the read before a write not counted), {:.2f} Gflop/s by x = x m + a in "
        "independent chains, two roundings each, {}. The ideal is the larger of bytes over the one and flops "
        "over the other.</p>\n",
        1e-9 * rates.bytes_per_second, 1e-9 * rates.flops_per_second, rates.instruction_set);
}

std::string methodsTable(const Performance& found) {
    std::string rows;
    for (const SceneTimes& times : found.scenes)
        for (const compare::Row& row : times.comparison.rows)
            rows += fmt::format("<tr><td>{}</td>{}</tr>\n", escapedHtml(times.scene.title),
                                compare::reportCells(row));
    return cardTable("<th>scene</th>" + compare::reportHeads(), rows, "second");
}

std::string notesHtml(const Performance& found) {
    std::string out;
    for (const std::string& note : found.notes) out += fmt::format("<li>{}</li>\n", escapedHtml(note));
    return out.empty() ? ""
                       : "<h2>What could not be measured</h2><div class='card'><ul>" + out + "</ul></div>\n";
}

std::string plotsWhere(const std::vector<FigurePlot>& plots, const std::string& prefix) {
    std::vector<FigurePlot> chosen;
    for (const FigurePlot& plot : plots)
        if (plot.name.starts_with(prefix)) chosen.push_back(plot);
    return plotsHtml(chosen);
}

}  // namespace

std::string performanceHtml(const Performance& found, const std::vector<FigurePlot>& plots) {
    return fmt::format(
               "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
               "content='width=device-width'><title>Performance</title><link rel='icon' href='data:,'>"
               "<style>{}{}{}</style></head><body><main><h1>Performance</h1><p>edgewise {}, <code>edgewise "
               "figure performance{} -o DIR</code>, seed 0<br>{}, {} threads, {:.0f} MiB</p>\n",
               compare::kReportStyle, kPlotStyle, kStyle, escapedHtml(version()),
               found.quick ? " --quick" : "", escapedHtml(found.machine.processor), found.machine.cores,
               found.machine.memory_mib) +
           summary(found) + "<h2>Bars</h2>" + barsTable(found) + "<h2>Error against run time</h2>" +
           plotsWhere(plots, "pareto-") + "<h2>Growth</h2>" + plotsWhere(plots, "growth-") +
           "<div style='height:14px'></div>" + growthTable(found) + kGrowthWords + "<h2>Stages</h2>" +
           plotsWhere(plots, "stages") + "<h2>Counts and what each costs</h2>" + unitsTable(found) +
           "<h2>Distance to the ideal</h2>" + distanceTable(found) + ratesText(found.rates) +
           "<h2>The ideal, box filter</h2>" + modelTable("box", 0.5) +
           fmt::format("<p class='under'>With the Gaussian of radius 2 a term is {:.0f} flops.</p>",
                       flopsPerTerm("gaussian", 2.0)) +
           "<h2>All methods</h2>" + methodsTable(found) + notesHtml(found) +
           "<h2>Definitions</h2><div class='card'>" + compare::reportDefinitions() +
           "</div></main>\n<script>" + compare::kSortScript + "</script></body></html>\n";
}

}  // namespace edgewise::figures
