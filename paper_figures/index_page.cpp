#include "paper_figures/index_page.h"

#include <fmt/format.h>

#include "paper_figures/claims_table.h"
#include "paper_figures/page_parts.h"
#include "pipeline/compare/report_page.h"
#include "pipeline/html_table.h"
#include "pipeline/html_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

std::string nameCell(const MadeFigure& made) {
    const std::string name = escapedHtml(made.figure->name);
    if (made.page.empty())
        return fmt::format("{}<br><span class='bad'>{}</span>", name, escapedHtml(made.why));
    return fmt::format("<a href='{}'>{}</a>{}", escapedHtml(made.page), name,
                       made.of_this_program ? "" : "<br><span class='bad'>of another build</span>");
}

std::string rowOf(const MadeFigure& made) {
    return fmt::format(
               "<tr><td>{}</td><td>{}</td><td style='text-align:left;white-space:normal'>{}</td><td "
               "style='text-align:left'><code>edgewise figure {}{} -o DIR</code></td>",
               nameCell(made), escapedHtml(made.figure->source), escapedHtml(made.figure->what),
               escapedHtml(made.figure->name), made.quick ? " --quick" : "") +
           (made.page.empty() ? emptyCell() : numberCell(made.seconds, "{:.1f}")) + "</tr>\n";
}

std::vector<ClaimsOf> claimsOfAll(const std::vector<MadeFigure>& made) {
    std::vector<ClaimsOf> all;
    for (const MadeFigure& one : made) all.push_back({one.figure, one.page, one.claims});
    return all;
}

}  // namespace

std::string indexHtml(const std::vector<MadeFigure>& made) {
    std::string rows;
    double seconds = 0.0;
    int there = 0;
    for (const MadeFigure& one : made)
        rows += rowOf(one), seconds += one.seconds, there += one.page.empty() ? 0 : 1;
    const std::string claims = claimsHtml(claimsOfAll(made));
    return fmt::format(
               "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
               "content='width=device-width'><title>Figures</title><link rel='icon' "
               "href='data:,'><style>{}</style>"
               "</head><body><main><h1>Figures</h1><p>edgewise {}; {} of {} figures, made in {:.0f} s</p>\n",
               compare::kReportStyle, escapedHtml(version()), there, figureRegistry().size(), seconds) +
           cardTable(
               "<th>figure</th><th>of</th><th style='text-align:left'>what</th><th "
               "style='text-align:left'>command</th><th>seconds</th>",
               rows) +
           (claims.empty() ? ""
                           : "<h2>Paper says, we measure, why they differ</h2>" + claims +
                                 "<p><a href='claims.csv'>claims.csv</a> has the same table.</p>") +
           fmt::format("</main><script>{}</script></body></html>\n", compare::kSortScript);
}

std::string indexCsv(const std::vector<MadeFigure>& made) {
    return claimsCsv(claimsOfAll(made));
}

}  // namespace edgewise::figures
