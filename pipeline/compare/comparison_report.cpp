#include "pipeline/compare/comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipeline/compare/base64.h"
#include "pipeline/compare/error_map.h"
#include "pipeline/compare/error_slope.h"
#include "pipeline/compare/kinds_tables.h"
#include "pipeline/compare/mesh_reference_text.h"
#include "pipeline/compare/pareto_plot.h"
#include "pipeline/compare/report_page.h"
#include "pipeline/error.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/json_text.h"
#include "pipeline/read_file.h"

namespace edgewise::compare {
namespace {

std::string embedded(const std::filesystem::path& path) {
    return "data:image/png;base64," + base64(readWholeFile(path, path.string()));
}

/// Inside a <script>: nothing in it may end the element.
std::string scriptJson(const nlohmann::ordered_json& json) {
    std::string text = jsonText(json);
    for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
        text.replace(at, 2, "<\\/");
    return text;
}

std::string picturesJson(const Comparison& comparison, const std::filesystem::path& folder,
                         const std::string& reference_png, const std::string& kinds_png) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    json.push_back(
        {{"name", "reference: " + comparison.reference}, {"picture", embedded(folder / reference_png)}});
    for (const Row& row : comparison.rows)
        if (!row.png.empty())
            json.push_back({{"name", row.method},
                            {"picture", embedded(folder / row.png)},
                            {"signed", embedded(folder / row.signed_map)},
                            {"absolute", embedded(folder / row.absolute_map)}});
    if (!kinds_png.empty())
        json.push_back({{"name", "kinds of edges"}, {"picture", embedded(folder / kinds_png)}});
    return scriptJson(json);
}

std::string filterText(const Row& row) {
    return fmt::format("{} R {}{}", row.filter, row.radius,
                       row.sigma ? fmt::format(", s {:.3g}", *row.sigma) : "");
}

std::string biasText(const Row& row) {
    if (!row.error) return "";
    return fmt::format("{:.1e}", row.error->bias) +
           (row.bias_half_width ? fmt::format(" &plusmn; {:.1e}", *row.bias_half_width) : "");
}

std::string tableRow(const Row& row) {
    const Spread s = spreadOf(row.seconds);
    std::string out = fmt::format("<td>{}</td><td>{}</td><td>{}</td>", escapedHtml(row.method),
                                  escapedHtml(filterText(row)), escapedHtml(row.device));
    out += s.runs > 0 ? sortedCell(s.median, fmt::format("{:.4g}", s.median)) +
                            sortedCell(s.max - s.min,
                                       fmt::format("{:.3g} &ndash; {:.3g}, {} runs", s.min, s.max, s.runs))
                      : sortedCell({}, fmt::format("<span class='bad'>{}</span>", nameOf(row.status))) +
                            sortedCell({}, escapedHtml(row.why));
    out +=
        numberCell(s.runs > 0 ? std::optional(spreadOf(row.setup_seconds).median) : std::nullopt, "{:.3g}");
    const auto error = [&](auto&& part) {
        return row.error ? std::optional<double>(part(*row.error)) : std::nullopt;
    };
    using Errors = judge::ErrorMetrics;
    out += numberCell(error([](const Errors& e) { return e.rmse; }), "{:.3e}");
    out += numberCell(row.error ? row.error->edge_rmse : std::nullopt, "{:.3e}");
    out += numberCell(error([](const Errors& e) { return e.max; }), "{:.3e}");
    out += sortedCell(error([](const Errors& e) { return e.bias; }), biasText(row));
    out += numberCell(row.error ? row.error->psnr : std::nullopt, "{:.2f}");
    out += numberCell(error([](const Errors& e) { return e.ssim; }), "{:.6f}");
    out += numberCell(error([](const Errors& e) { return e.flip; }), "{:.5f}");
    return out + numberCell(row.peak_mib, "{:.0f}");
}

std::string table(const Comparison& comparison) {
    std::string out = fmt::format("<table><thead><tr>{}</tr></thead><tbody>\n", reportHeads());
    for (const Row& row : comparison.rows) out += fmt::format("<tr>{}</tr>\n", tableRow(row));
    return out + "</tbody></table>\n";
}

std::string planOf(const Row& row) {
    std::string stages;
    for (const auto& [name, seconds] : row.stages)
        stages += fmt::format("<dt>{}</dt><dd>{:.4g} s</dd>", escapedHtml(name), spreadOf(seconds).median);
    std::string plan;
    for (const PlanEntry& entry : row.plan)
        plan += fmt::format("<dt>{}</dt><dd>{}: {}</dd>", escapedHtml(entry.stage),
                            entry.runs ? "runs" : "left out", escapedHtml(entry.why));
    std::string notes;
    if (!row.why.empty()) notes += fmt::format("<p>{}</p>", escapedHtml(row.why));
    for (const std::string& note : row.notes) notes += fmt::format("<p>{}</p>", escapedHtml(note));
    return fmt::format("<details><summary>{}</summary>{}<dl>{}</dl>{}</details>\n", escapedHtml(row.method),
                       notes, stages, plan.empty() ? "" : "<p>Plan</p><dl>" + plan + "</dl>");
}

constexpr const char* kDefinitions =
    "<dl><dt>seconds</dt><dd>wall time from the decoded scene to the float image in memory: the median of "
    "the runs, "
    "which took turns; set-up (acceleration structures, shaders, uploads) stands apart, loading and writing "
    "count "
    "nowhere</dd><dt>RMSE, max, bias, PSNR</dt><dd>over linear R, G, B in double precision, alpha left out; "
    "bias is "
    "the mean signed error with its 95 % confidence interval (batch means over blocks of 8x8 pixels), PSNR "
    "has peak 1 and is empty where there is no error</dd><dt>edge</dt><dd>over "
    "the pixels "
    "whose support holds visible owners of different colours, by the reference</dd><dt>SSIM</dt><dd>Wang's, "
    "Gaussian "
    "weights of sigma 1.5, data range 1, on the sRGB picture</dd><dt>FLIP</dt><dd>LDR-FLIP, 67 pixels a "
    "degree, mean, "
    "on the sRGB picture</dd><dt>reference</dt><dd>each row is judged against the reference with that row's "
    "own "
    "filter; visibility is exact there, while shading is one sample a (pixel, "
    "primitive)</dd><dt>MiB</dt><dd>the peak "
    "of each method's own process</dd></dl>";

std::string slopesText(const Comparison& c) {
    std::string out;
    for (const ErrorSlope& s : errorSlopes(c.rows))
        out += fmt::format(
            "<p>{}, {:.0f} to {:.0f} samples a pixel: RMSE falls like samples<sup>{:.3f}</sup>{}{}</p>",
            escapedHtml(s.family), s.least, s.most, s.slope,
            s.edge_slope ? fmt::format(", on the edge pixels {:.3f}", *s.edge_slope) : "",
            s.few_edges_slope
                ? fmt::format(", where a support holds one or two edges, none parallel to an axis, {:.3f}",
                              *s.few_edges_slope)
                : "");
    return out;
}

std::string viewer() {
    return fmt::format(
        "<div class='bar'><label>left <select id='left'></select></label><label>right <select "
        "id='right'></select>"
        "</label><label>show <select id='kind'><option value='picture'>pictures</option><option "
        "value='signed'>signed "
        "error</option><option value='absolute'>absolute error</option></select></label><button id='flip' "
        "title='key f'>flip</button><label><input type='checkbox' id='side' checked> side by "
        "side</label><button "
        "id='whole'>whole</button><button id='pixels'>pixels</button><span id='zoom'></span>"
        "<span class='scale' data-kind='signed' hidden>&minus;1 <i style='background:{}'></i> 1, log from "
        "1e-5</span>"
        "<span class='scale' data-kind='absolute' hidden>1e-5 <i style='background:{}'></i> 1, "
        "log</span></div>"
        "<div class='views'><div class='view'><canvas></canvas><b></b></div><div class='view "
        "second'><canvas></canvas>"
        "<b></b></div></div>",
        signedGradient(), absoluteGradient());
}

}  // namespace

std::string comparisonHtml(const Comparison& c, const std::filesystem::path& folder,
                           const std::string& reference_png, const std::string& kinds_png) {
    std::string plans;
    for (const Row& row : c.rows) plans += planOf(row);
    return fmt::format(
               "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
               "content='width=device-width'><title>{0}: error against run time</title><link rel='icon' "
               "href='data:,'>"
               "<style>{1}</style></head><body><main><h1>{0}: error against run time</h1><p>edgewise {2}, "
               "reference "
               "<code>{3}</code><br><code>{4}</code><br>{5}, {6} threads, {7:.0f} MiB</p>\n",
               escapedHtml(c.scene), kReportStyle, escapedHtml(c.version), escapedHtml(c.reference),
               escapedHtml(c.command), escapedHtml(c.machine.processor), c.machine.cores,
               c.machine.memory_mib) +
           "<div class='card'>" + paretoSvg(c) + slopesText(c) +
           "</div>\n<h2>Methods</h2><div class='card scroll'>" + table(c) + meshReferenceHtml(c) +
           "</div>\n" + (tellsKinds(c) ? "<h2>By kinds of edges</h2>" + kindsTable(c) : "") +
           "<h2>Pictures</h2><div class='card'>" + viewer() +
           "</div>\n<h2>Stages, plans and what was left out</h2><div class='card'>" + plans +
           "</div>\n<h2>Definitions</h2><div class='card'>" + kDefinitions +
           (tellsKinds(c) ? "<dl>" + judge::edgeKindDefinitions() + "</dl>" : "") +
           "</div></main>\n<script type='application/json' id='pictures'>" +
           picturesJson(c, folder, reference_png, kinds_png) + "</script><script>" + kReportScript +
           kSortScript + "</script></body></html>\n";
}

std::string reportHeads() {
    return "<th>method</th><th>filter</th><th>device</th><th>seconds</th><th>spread</th><th>set-up, "
           "s</th><th>RMSE</th><th>edge RMSE</th><th>max</th><th>bias</th><th>PSNR, "
           "dB</th><th>SSIM</th><th>FLIP</th><th>MiB</th>";
}

std::string reportCells(const Row& row) {
    return tableRow(row);
}

std::string reportDefinitions() {
    return kDefinitions;
}

}  // namespace edgewise::compare
