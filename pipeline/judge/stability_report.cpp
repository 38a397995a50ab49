#include "pipeline/judge/stability_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "pipeline/judge/stability_cases.h"
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

Json rowJson(const StabilityRow& r) {
    return {{"case", r.case_name},
            {"filter", r.filter},
            {"condition", r.condition},
            {"scenes", r.scenes},
            {"weights", r.weights},
            {"max_error", r.max_error},
            {"max_error_ulp", r.max_error_ulp},
            {"max_relative", r.max_relative},
            {"bound", r.bound},
            {"worst_of_bound", r.worst_of_bound},
            {"ownership_errors", r.ownership_errors},
            {"partition_defect", r.partition_defect},
            {"label_conflicts", r.label_conflicts},
            {"exact_depths", r.exact_depths},
            {"fine_orders", r.fine_orders},
            {"closings", r.closings},
            {"seconds", r.seconds},
            {"oracle_error", r.oracle_error},
            {"projection", projectionJson(r.projection)}};
}

/// What a plot's axis spans, in decades.
struct Axis {
    double low, high;
    double at(double value) const { return (std::log10(value) - low) / (high - low); }
};

Axis axisOver(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    const double from = std::floor(std::log10(low)), to = std::ceil(std::log10(high));
    return {from, std::max(to, from + 1)};
}

/// One case: points and lines in a box of kWidth x kHeight with decades marked.
class Plot {
  public:
    Plot(const StabilityCase& one, const Rows& rows)
        : case_(one), rows_(rows), x_(axisOver(one.difficulties)) {}

    std::string svg() const {
        std::string out = fmt::format("<figure><svg viewBox='0 0 {} {}' role='img' aria-label='{}'>\n",
                                      kWidth + kLeft + 12, kHeight + kTop + 40, case_.name);
        out += frame();
        std::size_t color = 0;
        for (const auto& [filter, rows] : byFilter()) out += series(rows, kColors[color++ % kColors.size()]);
        out += fmt::format("</svg><figcaption><b>{}</b>: {}</figcaption></figure>\n", case_.name, case_.what);
        return out;
    }

    static constexpr std::array kColors{"#1b6ca8", "#c8553d", "#3a7d44", "#7d4e9e", "#b08900", "#4a4a4a"};

    std::map<std::string, std::vector<const StabilityRow*>> byFilter() const {
        std::map<std::string, std::vector<const StabilityRow*>> out;
        for (const StabilityRow& row : rows_)
            if (row.case_name == case_.name) out[row.filter].push_back(&row);
        return out;
    }

  private:
    static constexpr double kWidth = 300, kHeight = 190, kLeft = 46, kTop = 10;
    static constexpr Axis kError{-19, -9};

    /// What is 0 lies on the floor of the plot.
    static double floored(double error) { return std::clamp(error, 1e-19, 1e-9); }
    double px(double condition) const { return kLeft + kWidth * x_.at(condition); }
    static double py(double error) { return kTop + kHeight * (1 - kError.at(floored(error))); }

    std::string frame() const {
        std::string out = fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class='frame'/>", kLeft,
                                      kTop, kWidth, kHeight);
        for (double e = kError.low; e <= kError.high; e += 2)
            out +=
                fmt::format("<text x='{}' y='{}' class='y'>1e{:.0f}</text><path d='M{} {}h{}' class='grid'/>",
                            kLeft - 4, py(std::pow(10, e)) + 3, e, kLeft, py(std::pow(10, e)), kWidth);
        const double step = std::max(1.0, std::ceil((x_.high - x_.low) / 6));
        for (double e = x_.low; e <= x_.high; e += step)
            out += fmt::format("<text x='{}' y='{}' class='x'>1e{:.0f}</text>", px(std::pow(10, e)),
                               kTop + kHeight + 13, e);
        return out + fmt::format("<text x='{}' y='{}' class='x'>{}</text>\n", kLeft + kWidth / 2,
                                 kTop + kHeight + 28, case_.condition);
    }

    std::string series(const std::vector<const StabilityRow*>& rows, const char* color) const {
        std::string line, bound, dots;
        for (const StabilityRow* r : rows) {
            const char* command = line.empty() ? "M" : "L";
            line += fmt::format("{}{:.1f} {:.1f}", command, px(r->condition), py(r->max_error));
            bound += fmt::format("{}{:.1f} {:.1f}", command, px(r->condition), py(r->bound));
            dots += fmt::format(
                "<circle cx='{:.1f}' cy='{:.1f}' r='2.4'><title>{} at {:.3g}: {:.3g}</title></circle>",
                px(r->condition), py(r->max_error), r->filter, r->condition, r->max_error);
        }
        return fmt::format(
            "<g fill='{0}' stroke='{0}'><path d='{1}' fill='none'/><path d='{2}' class='bound'/>{3}</g>\n",
            color, line, bound, dots);
    }

    const StabilityCase& case_;
    const Rows& rows_;
    Axis x_;
};

const char* const kStyle =
    "body{font:14px/1.4 system-ui,sans-serif;margin:24px;max-width:1200px}"
    "figure{display:inline-block;width:370px;margin:0 10px 18px 0;vertical-align:top}svg{width:100%}"
    ".frame{fill:none;stroke:#888}.grid{stroke:#e4e4e4}.y{font-size:9px;text-anchor:end}.x{font-size:9px;"
    "text-anchor:middle}"
    ".bound{fill:none;stroke-dasharray:4 3;opacity:.6}table{border-collapse:collapse;font-size:12px}"
    "td,th{padding:2px 8px;border-bottom:1px solid "
    "#ddd;text-align:right}td:first-child,th:first-child{text-align:left}";

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return out;
}

std::string tableHtml(const Rows& rows) {
    std::string out =
        "<table><tr><th>case</th><th>filter</th><th>condition</th><th>max error</th><th>ulp</th><th>of its "
        "bound</th><th>ownership errors</th><th>partition defect</th><th>label conflicts</th><th>exact "
        "depths</th>"
        "<th>closings</th><th>&micro;s</th></tr>\n";
    for (const StabilityRow& r : rows)
        out += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{:.3g}</td><td>{:.2e}</td><td>{:.3g}</td><td>{:.2f}</td><td>{}</"
            "td>"
            "<td>{:g}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.1f}</td></tr>\n",
            r.case_name, r.filter, r.condition, r.max_error, r.max_error_ulp, r.worst_of_bound,
            r.ownership_errors, r.partition_defect, r.label_conflicts, r.exact_depths, r.closings,
            r.seconds * 1e6);
    return out + "</table>";
}

std::string legend(const Rows& rows) {
    std::map<std::string, int> filters;
    for (const StabilityRow& r : rows) filters.try_emplace(r.filter, 0);
    std::string out = "<p>";
    std::size_t color = 0;
    for (const auto& [name, unused] : filters)
        out += fmt::format("<span style='color:{}'>&#9679; {}</span> &nbsp; ",
                           Plot::kColors[color++ % Plot::kColors.size()], escaped(name));
    return out + "&nbsp; dashed: the promised bound</p>\n";
}

}  // namespace

std::string stabilityJson(const Rows& rows, const std::string& command) {
    Json json{{"command", command}, {"version", version()}, {"rows", Json::array()}};
    for (const StabilityRow& row : rows) json["rows"].push_back(rowJson(row));
    return json.dump(1) + "\n";
}

std::string stabilityCsv(const Rows& rows) {
    std::string out;
    const Json columns = rowJson(StabilityRow{});
    for (const auto& [key, value] : columns.items()) out += (out.empty() ? "" : ",") + key;
    out += '\n';
    for (const StabilityRow& row : rows) {
        std::string line;
        const Json json = rowJson(row);
        for (const auto& [key, value] : json.items())
            line += (line.empty() ? "" : ",") + (value.is_string() ? value.get<std::string>() : value.dump());
        out += line + '\n';
    }
    return out;
}

std::string stabilityLatex(const Rows& rows) {
    std::map<std::pair<std::string, std::string>, const StabilityRow*> worst;
    for (const StabilityRow& row : rows) {
        const StabilityRow*& kept = worst[{row.case_name, row.filter}];
        if (!kept || row.max_error > kept->max_error) kept = &row;
    }
    std::string out =
        "\\begin{tabular}{llrrrr}\n\\toprule\ncase & filter & worst at & max error & of its bound & "
        "ownership "
        "errors\\\\\n\\midrule\n";
    for (const auto& [key, row] : worst)
        out += fmt::format("{} & {} & {:.0e} & {:.1e} & {:.2f} & {}\\\\\n", row->case_name, row->filter,
                           row->condition, row->max_error, row->worst_of_bound, row->ownership_errors);
    return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string stabilityHtml(const Rows& rows, const std::string& command) {
    std::string out = fmt::format(
        "<!DOCTYPE html><html lang='en'><meta charset='utf-8'><title>edgewise "
        "stability</title><style>{}</style>"
        "<h1>Numerical stability</h1><p>Largest error of a pixel's weight against the exact oracle, over the "
        "difficulty of "
        "each case. 0 is drawn on the floor of a plot. edgewise {}, <code>{}</code></p>\n",
        kStyle, version(), escaped(command));
    out += legend(rows);
    for (const StabilityCase& one : stabilityCases())
        if (std::ranges::any_of(rows, [&](const StabilityRow& r) { return r.case_name == one.name; }))
            out += Plot(one, rows).svg();
    return out + tableHtml(rows) + "</html>\n";
}

}  // namespace edgewise::judge
