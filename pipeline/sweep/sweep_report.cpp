#include "pipeline/sweep/sweep_report.h"

#include <fmt/format.h>

#include <map>

#include "pipeline/compare/comparison_report.h"
#include "pipeline/compare/pareto_plot.h"
#include "pipeline/compare/report_page.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/version.h"

namespace edgewise::sweep {
namespace {

constexpr const char* kSweepStyle = R"css(
.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(460px,1fr));gap:14px}
figure{margin:0}figcaption{font-weight:600;margin-bottom:6px}
.jobs td:nth-child(-n+5),.jobs th:nth-child(-n+5){text-align:left}
)css";

/// One machine's.
struct Part {
    std::string title, plots, rows;
};

std::string plotOf(const JobRecord& job, const Measurement& m) {
    compare::Comparison comparison;
    comparison.rows = m.rows;
    return fmt::format("<figure class='card'><figcaption>{}</figcaption>{}</figure>\n",
                       escapedHtml(titleOf(job)), compare::paretoSvg(comparison));
}

std::string rowsOf(const JobRecord& job, const Measurement& m) {
    std::string out;
    for (const compare::Row& row : m.rows)
        out += fmt::format("<tr><td>{}</td><td>{}</td>{}{}</tr>\n",
                           escapedHtml(job.job.at("scene").get<std::string>()),
                           escapedHtml(job.job.at("camera").get<std::string>()),
                           sortedCell(static_cast<double>(row.size.x) * row.size.y,
                                      fmt::format("{}x{}", row.size.x, row.size.y)),
                           compare::reportCells(row));
    return out;
}

std::map<std::string, Part> partsOf(const SweepResults& results) {
    std::map<std::string, Part> parts;
    for (const JobRecord& job : results.jobs)
        for (const Measurement& m : job.results) {
            Part& part = parts[machineName(m.machine)];
            part.title = titleOf(m.machine);
            part.plots += plotOf(job, m);
            part.rows += rowsOf(job, m);
        }
    return parts;
}

std::string partHtml(const Part& part) {
    return fmt::format("<h2>{}</h2><div class='plots'>{}</div>\n<p></p>", escapedHtml(part.title),
                       part.plots) +
           cardTable("<th>scene</th><th>camera</th><th>size</th>" + compare::reportHeads(), part.rows,
                     "jobs");
}

std::string disagreementsHtml(const SweepResults& results) {
    std::string out;
    for (const std::string& text : results.disagreements)
        out += fmt::format("<p class='bad'>{}</p>\n", escapedHtml(text));
    return out;
}

}  // namespace

std::string resultsHtml(const SweepResults& results) {
    const auto parts = partsOf(results);
    std::string body;
    for (const auto& [name, part] : parts) body += partHtml(part);
    return fmt::format(
               "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
               "content='width=device-width'><title>sweep: error against run time</title><link rel='icon' "
               "href='data:,'><style>{}{}</style></head><body><main><h1>Error against run time</h1>"
               "<p>edgewise {}, jobs: {}, machines: {}; times of different machines stand apart</p>\n",
               compare::kReportStyle, kSweepStyle, version(), results.jobs.size(), parts.size()) +
           disagreementsHtml(results) + body + "<h2>Definitions</h2><div class='card'>" +
           compare::reportDefinitions() + "</div></main><script>" + compare::kSortScript +
           "</script></body></html>\n";
}

}  // namespace edgewise::sweep
