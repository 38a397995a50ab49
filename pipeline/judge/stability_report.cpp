#include "pipeline/judge/stability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "pipeline/html_text.h"
#include "pipeline/json_text.h"
#include "pipeline/judge/stability_cases.h"
#include "pipeline/judge/stability_plot.h"
#include "pipeline/plot_colors.h"
#include "pipeline/version.h"

namespace edgewise::judge {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<StabilityRow>;

/// Null for rows whose scenes no camera made.
Json projectionJson(const std::optional<ProjectionErrors>& p) {
    if (!p) return nullptr;
    return {{"max_px", p->max_px},
            {"bound_px", p->bound_px},
            {"worst_of_bound", p->worst_of_bound},
            {"vertices", p->vertices},
            {"made", p->made},
            {"undecided", p->undecided},
            {"shared_edges", p->shared_edges},
            {"cracks", p->cracks},
            {"lost_areas", p->lost_areas}};
}

/// Null where no map was compared.
Json mapJson(const std::optional<MapReport>& m) {
    if (!m) return nullptr;
    return {{"maps", m->maps},
            {"faces", m->faces},
            {"faces_with_disk", m->faces_with_disk},
            {"points", m->points},
            {"ownership_errors", m->ownership_errors},
            {"first_ownership_error", m->first.empty() ? Json() : Json(m->first)},
            {"small_faces", m->small_faces},
            {"small_faces_unproven", m->unsure_faces},
            {"small_area_px2", m->small_area_px2},
            {"small_faces_wrong", m->small_wrong.size()},
            {"small_wrong_area_px2", m->small_wrong_area_px2},
            {"max_area_share", m->max_area_share}};
}

Json errorsJson(const WeightErrors& e) {
    return {{"max_error", e.max_error},
            {"max_error_ulp", e.max_error_ulp},
            {"max_relative", e.max_relative},
            {"bound", e.bound},
            {"worst_of_bound", e.worst_of_bound},
            {"ownership_errors", e.ownership_errors},
            {"partition_defect", e.partition_defect},
            {"label_conflicts", e.label_conflicts},
            {"seconds", e.seconds}};
}

Json rowJson(const StabilityRow& r) {
    Json json{{"case", r.case_name},
              {"filter", r.filter},
              {"condition", r.condition},
              {"scenes", r.scenes},
              {"weights", r.weights}};
    json.update(errorsJson(r));
    json.update({{"exact_depths", r.exact_depths},
                 {"fine_orders", r.fine_orders},
                 {"closings", r.closings},
                 {"oracle_error", r.oracle_error},
                 {"fp32", errorsJson(r.fp32)},
                 {"map", mapJson(r.map)},
                 {"map_left_out", r.map_left_out.empty() ? Json() : Json(r.map_left_out)},
                 {"projection", projectionJson(r.projection)}});
    return json;
}

/// Every filter has one colour on the whole page.
std::map<std::string, std::string> colorsOf(const Rows& rows) {
    std::map<std::string, std::string> out;
    for (const StabilityRow& row : rows) out.try_emplace(row.filter, "");
    std::size_t next = 0;
    for (auto& [filter, color] : out) color = kPlotColors[next++ % kPlotColors.size()];
    return out;
}

enum class Judged { kWeights, kFloatWeights, kVertices };

const WeightErrors& errorsOf(const StabilityRow& r, Judged judged) {
    return judged == Judged::kFloatWeights ? r.fp32 : r;
}

std::vector<PlotSeries> seriesOf(const Rows& rows, const std::string& case_name, Judged judged) {
    std::map<std::string, PlotSeries> by_filter;
    const auto colors = colorsOf(rows);
    for (const StabilityRow& r : rows) {
        if (r.case_name != case_name || (judged == Judged::kVertices && !r.projection)) continue;
        PlotSeries& one = by_filter[r.filter];
        one.name = r.filter, one.color = colors.at(r.filter);
        const WeightErrors& errors = errorsOf(r, judged);
        if (judged == Judged::kVertices)
            one.points.push_back({r.condition, r.projection->max_px, r.projection->bound_px});
        else
            one.points.push_back({r.condition, errors.max_error, errors.bound});
    }
    std::vector<PlotSeries> out;
    for (auto& [filter, one] : by_filter) {
        std::ranges::sort(one.points, {}, &PlotPoint::x);
        out.push_back(std::move(one));
    }
    return out;
}

/// The same decades for every plot of weights of one precision, so that eyes can compare.
PlotAxis weightAxis(const Rows& rows, Judged judged) {
    PlotAxis all = judged == Judged::kFloatWeights ? PlotAxis{-12, -5} : PlotAxis{-18, -12};
    for (const StabilityRow& r : rows)
        for (const double v : {errorsOf(r, judged).max_error, errorsOf(r, judged).bound})
            if (v > 0.0) all.high = std::max(all.high, static_cast<int>(std::ceil(std::log10(v))));
    return all;
}

std::string figureHtml(const StabilityCase& one, const Rows& rows, Judged judged) {
    const auto series = seriesOf(rows, one.name, judged);
    if (series.empty()) return "";
    const bool weights = judged != Judged::kVertices;
    const PlotFrame frame{one.condition,
                          weights ? "largest error of a weight" : "largest error of a vertex, px",
                          one.name + ": error against " + one.condition, xAxisOf(series),
                          weights ? weightAxis(rows, judged) : errorAxisOf(series)};
    double of_bound = 0.0;
    for (const StabilityRow& r : rows)
        if (r.case_name == one.name)
            of_bound = std::max(of_bound,
                                weights ? errorsOf(r, judged).worst_of_bound : r.projection->worst_of_bound);
    return fmt::format(
        "<figure><figcaption><b>{}{}</b><span class='{}'>{:.2g} of the bound</span><br>{}"
        "</figcaption>{}</figure>\n",
        escapedHtml(one.name),
        judged == Judged::kWeights        ? ""
        : judged == Judged::kFloatWeights ? ", fp32"
                                          : ", projection",
        of_bound <= 1.0 ? "good" : "bad", of_bound, escapedHtml(one.what), plotSvg(frame, series));
}

const char* const kStyle =
    "body{font:15px/1.45 system-ui,sans-serif;color:#222;margin:0;background:#f6f6f4}"
    "main{max-width:1640px;margin:0 auto;padding:24px}h1{margin:0 0 4px}h2{margin:28px 0 8px;font-size:19px}"
    "code{background:#ececea;padding:1px 5px;border-radius:3px;font-size:13px;overflow-wrap:anywhere}"
    ".figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(370px,1fr));gap:14px}"
    "figure{margin:0;background:#fff;border:1px solid #ddd;border-radius:6px;padding:10px 12px}"
    "figcaption{font-size:13px;min-height:3.9em}figcaption span{float:right;font-size:12px}"
    ".good{color:#2c6e3f}.bad{color:#b3261e;font-weight:bold}svg{width:100%;display:block}"
    "svg text{font-size:10px;fill:#444}svg .title{font-size:11px;fill:#222}"
    ".frame{fill:none;stroke:#777}.grid{stroke:#ddd}.fine{stroke:#f0f0f0}"
    ".line{fill:none;stroke-width:1.4}.bound{fill:none;stroke-dasharray:5 3;opacity:.65}"
    ".zero{fill:#fff;stroke-width:1.2}"
    ".legend{position:sticky;top:0;background:#f6f6f4ee;padding:8px 0;display:flex;flex-wrap:wrap;gap:4px "
    "16px}"
    ".legend span{white-space:nowrap}"
    "i{display:inline-block;width:18px;height:4px;border-radius:2px;margin-right:6px;vertical-align:middle}"
    ".scroll{overflow-x:auto;background:#fff;border:1px solid #ddd;border-radius:6px;padding:6px}"
    "table{border-collapse:collapse;font-size:12.5px;font-variant-numeric:tabular-nums}"
    "td,th{padding:3px 9px;border-bottom:1px solid #e5e5e5;text-align:right;white-space:nowrap}"
    "th{white-space:normal;vertical-align:bottom;line-height:1.2}td:first-child,th:first-child,td:nth-child("
    "2),th:nth-child(2){text-align:left}"
    "summary{cursor:pointer;margin:14px 0 8px}";

/// What was compared, and why the rest was not.
std::string mapCells(const StabilityRow& r) {
    if (!r.map) return fmt::format("<td colspan='4'>{}</td>", escapedHtml(r.map_left_out));
    const MapReport& m = *r.map;
    return fmt::format("<td>{}</td><td>{} of {}</td><td>{:.2g}</td><td>{:.1e}{}</td>", m.ownership_errors,
                       m.small_wrong.size(), m.small_faces, m.small_wrong_area_px2, m.max_area_share,
                       r.map_left_out.empty() ? "" : "; others: " + escapedHtml(r.map_left_out));
}

std::string projectionCells(const std::optional<ProjectionErrors>& p) {
    if (!p) return "<td></td><td></td><td></td>";
    return fmt::format("<td>{:.2e}</td><td>{:.2f}</td><td>{}</td>", p->max_px, p->worst_of_bound, p->cracks);
}

std::string tableHtml(const Rows& rows) {
    std::string out =
        "<div class='scroll'><table><tr><th>case</th><th>filter</th><th>condition</th><th>max error</th>"
        "<th>ulp</th><th>of its bound</th><th>fp32 max error</th><th>of its bound</th><th>ownership "
        "errors</th><th>in the map</th><th>small faces shown "
        "otherwise</th><th>their area, px&sup2;</th><th>area error, of the support's square</th>"
        "<th>partition defect</th><th>label conflicts</th><th>exact depths</th><th>fine orders</th>"
        "<th>closings</th><th>&micro;s</th><th>vertex, px</th><th>of its bound</th><th>cracks</th></tr>\n";
    for (const StabilityRow& r : rows)
        out += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{:.3g}</td><td>{:.2e}</td><td>{:.3g}</td><td>{:.2f}</td>"
            "<td>{:.2e}</td><td>{:.2f}</td><td>{}</td>{}<td>{:g}</td><td>{}</td><td>{}</td><td>{}</"
            "td><td>{}</td><td>{:.1f}</td>{}</tr>\n",
            escapedHtml(r.case_name), escapedHtml(r.filter), r.condition, r.max_error, r.max_error_ulp,
            r.worst_of_bound, r.fp32.max_error, r.fp32.worst_of_bound, r.ownership_errors, mapCells(r),
            r.partition_defect, r.label_conflicts, r.exact_depths, r.fine_orders, r.closings, r.seconds * 1e6,
            projectionCells(r.projection));
    return out + "</table></div>\n";
}

bool worse(const StabilityRow& a, const StabilityRow& b) {
    return std::pair(!keepsPromises(a), a.worst_of_bound) > std::pair(!keepsPromises(b), b.worst_of_bound);
}

/// The row of each (case, filter) that breaks a promise, or else comes nearest to its bound.
Rows worstRows(const Rows& rows) {
    std::map<std::pair<std::string, std::string>, const StabilityRow*> worst;
    for (const StabilityRow& row : rows) {
        const StabilityRow*& kept = worst[{row.case_name, row.filter}];
        if (!kept || worse(row, *kept)) kept = &row;
    }
    Rows out;
    for (const auto& [key, row] : worst) out.push_back(*row);
    return out;
}

std::string legend(const Rows& rows) {
    std::string out = "<p class='legend'>";
    for (const auto& [name, color] : colorsOf(rows))
        out += fmt::format("<span><i style='background:{}'></i>{}</span>", color, escapedHtml(name));
    return out + "<span>dashed: the promised bound</span><span>hollow: no error at all</span></p>\n";
}

std::string mapSummary(const Rows& rows) {
    MapReport all;
    std::size_t left_out = 0;
    for (const StabilityRow& r : rows) {
        if (r.map) all.add(*r.map);
        left_out += !r.map_left_out.empty();
    }
    return fmt::format(
        "{} maps compared face by face ({} rows left out): {} ownership errors at {} points of {} faces "
        "with a disk of 2<sup>&#8722;30</sup> px and of the background; {} of {} smaller faces shown "
        "otherwise, of "
        "{:.1e} px&sup2;; areas within {:.1e} of the support's square.",
        all.maps, left_out, all.ownership_errors, all.points, all.faces_with_disk, all.small_wrong.size(),
        all.small_faces, all.small_wrong_area_px2, all.max_area_share);
}

std::string summary(const Rows& rows) {
    std::size_t weights = 0, beyond = 0;
    for (const StabilityRow& r : rows) weights += r.weights, beyond += !keepsPromises(r);
    return fmt::format("<p class='{}'>{} weights in {} rows; {}. {}</p>", beyond == 0 ? "good" : "bad",
                       weights, rows.size(),
                       beyond == 0 ? "every one within its bound, with the oracle's owners"
                                   : fmt::format("{} rows break a promise", beyond),
                       mapSummary(rows));
}

/// Objects become columns of their own, "projection.max_px"; null is an empty cell.
void flatten(const Json& json, const std::string& prefix, std::vector<std::pair<std::string, Json>>& out) {
    for (const auto& [key, value] : json.items())
        if (value.is_object())
            flatten(value, prefix + key + ".", out);
        else
            out.emplace_back(prefix + key, value);
}

/// Quoted where a comma is in it: `bc:1,0`.
std::string csvCell(const Json& value) {
    if (value.is_null()) return "";
    if (!value.is_string()) return jsonText(value);
    const auto text = value.get<std::string>();
    return text.find_first_of(",\"\n") == std::string::npos ? text : '"' + text + '"';
}

std::vector<std::pair<std::string, Json>> csvCells(const StabilityRow& row) {
    Json json = rowJson(row);
    for (const auto& [key, columns] : {std::pair("map", mapJson(MapReport())),
                                       std::pair("projection", projectionJson(ProjectionErrors()))}) {
        if (!json[key].is_null()) continue;
        json[key] = columns;
        for (Json& value : json[key]) value = nullptr;
    }
    std::vector<std::pair<std::string, Json>> cells;
    flatten(json, "", cells);
    return cells;
}

std::string mapColumns(const StabilityRow& r) {
    if (!r.map) return fmt::format("\\multicolumn{{4}}{{l}}{{{}}}", r.map_left_out);
    const MapReport& m = *r.map;
    return fmt::format("{} & {} & {:.1e} & {:.1e}", m.ownership_errors, m.small_wrong.size(),
                       m.small_wrong_area_px2, m.max_area_share);
}

}  // namespace

std::string stabilityJson(const Rows& rows, const std::string& command) {
    Json json{{"command", command}, {"version", version()}, {"rows", Json::array()}};
    for (const StabilityRow& row : rows) json["rows"].push_back(rowJson(row));
    return jsonText(json, 1) + "\n";
}

std::string stabilityCsv(const Rows& rows) {
    std::string out, names;
    for (const auto& [key, value] : csvCells(StabilityRow())) names += (names.empty() ? "" : ",") + key;
    out = names + '\n';
    for (const StabilityRow& row : rows) {
        std::string line;
        for (const auto& [key, value] : csvCells(row)) line += (line.empty() ? "" : ",") + csvCell(value);
        out += line + '\n';
    }
    return out;
}

std::string stabilityLatex(const Rows& rows) {
    std::string out =
        "\\begin{tabular}{llrrrrrrrrrrr}\n\\toprule\ncase & filter & worst at & max error & of its bound & "
        "fp32 & of its bound & "
        "ownership errors & in the map & small faces & px$^2$ & area & vertices, px\\\\\n\\midrule\n";
    for (const StabilityRow& row : worstRows(rows))
        out +=
            fmt::format("{} & {} & {:.0e} & {:.1e} & {:.2f} & {:.1e} & {:.2f} & {} & {} & {}\\\\\n",
                        row.case_name, row.filter, row.condition, row.max_error, row.worst_of_bound,
                        row.fp32.max_error, row.fp32.worst_of_bound, row.ownership_errors, mapColumns(row),
                        row.projection ? fmt::format("{:.1e}", row.projection->max_px) : std::string("--"));
    return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string stabilityHtml(const Rows& rows, const std::string& command) {
    std::string out = fmt::format(
        "<!DOCTYPE html><html lang='en'><meta charset='utf-8'><meta name='viewport' "
        "content='width=device-width'><title>edgewise stability</title><style>{}</style><main>"
        "<h1>Numerical stability</h1>{}<p>The largest error of a pixel's weights against exact arithmetic, "
        "over the difficulty of each case; for scenes that a camera sees, also the largest distance of a "
        "projected vertex from its exact place. edgewise {}, <code>{}</code></p>\n",
        kStyle, summary(rows), version(), escapedHtml(command));
    out += legend(rows) + "<div class='figures'>\n";
    for (const StabilityCase& one : stabilityCases())
        for (const Judged judged : {Judged::kWeights, Judged::kFloatWeights, Judged::kVertices})
            out += figureHtml(one, rows, judged);
    out += "</div>\n<h2>The worst of each case and filter</h2>\n" + tableHtml(worstRows(rows));
    return out + "<details><summary>All rows</summary>\n" + tableHtml(rows) + "</details></main></html>\n";
}

}  // namespace edgewise::judge
