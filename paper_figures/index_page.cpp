#include "paper_figures/index_page.h"

#include <fmt/format.h>

#include "pipeline/compare/report_page.h"
#include "pipeline/html_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

std::string rowOf(const MadeFigure& made, bool quick) {
    const Figure& figure = *made.figure;
    const std::string name = escapedHtml(figure.name);
    const std::string link =
        made.page.empty() ? fmt::format("{}<br><span class='bad'>{}</span>", name, escapedHtml(made.why))
                          : fmt::format("<a href='{}'>{}</a>", escapedHtml(made.page), name);
    return fmt::format(
        "<tr><td>{}</td><td>{}</td><td style='text-align:left'>{}</td><td "
        "style='text-align:left'><code>edgewise figure {}{} -o DIR</code></td></tr>\n",
        link, escapedHtml(figure.source), escapedHtml(figure.what), name, quick ? " --quick" : "");
}

}  // namespace

std::string indexHtml(const std::vector<MadeFigure>& made, bool quick) {
    std::string rows;
    for (const MadeFigure& one : made) rows += rowOf(one, quick);
    return fmt::format(
        "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
        "content='width=device-width'><title>Figures</title><link rel='icon' href='data:,'><style>{}</style>"
        "</head><body><main><h1>Figures</h1><p>edgewise {}</p><div class='card scroll'><table><thead><tr>"
        "<th>figure</th><th>of</th><th style='text-align:left'>what</th><th "
        "style='text-align:left'>command</th>"
        "</tr></thead><tbody>\n{}</tbody></table></div></main><script>{}</script></body></html>\n",
        compare::kReportStyle, escapedHtml(version()), rows, compare::kSortScript);
}

}  // namespace edgewise::figures
