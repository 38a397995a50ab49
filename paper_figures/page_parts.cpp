#include "paper_figures/page_parts.h"

#include <fmt/format.h>

#include "paper_figures/figure_plot.h"
#include "pipeline/compare/report_page.h"
#include "pipeline/html_text.h"
#include "pipeline/version.h"

namespace edgewise::figures {
namespace {

std::string parametersHtml(const FigureWords& words) {
    std::string out = "<div class='card'><dl>";
    for (const auto& [name, value] : words.parameters)
        out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escapedHtml(name), escapedHtml(value));
    if (!words.commands.empty()) out += "<dt>by hand</dt><dd>";
    for (const std::string& command : words.commands)
        out += fmt::format("<code>{}</code><br>\n", escapedHtml(command));
    return out + (words.commands.empty() ? "" : "</dd>") + "</dl></div>\n";
}

}  // namespace

std::string figurePage(const FigureWords& words, const std::string& body) {
    return fmt::format(
               "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
               "content='width=device-width'><title>{0}</title><link rel='icon' "
               "href='data:,'><style>{1}{2}{3}</style></head><body><main><h1>{0}</h1><p>edgewise {4}, "
               "<code>edgewise figure {5}{6} -o DIR</code></p><p>{7}</p>\n",
               escapedHtml(words.title), compare::kReportStyle, kPageStyle, kPlotStyle,
               escapedHtml(version()), escapedHtml(words.name), words.quick ? " --quick" : "",
               escapedHtml(words.caption)) +
           body + "<h2>Parameters</h2>" + parametersHtml(words) + "</main>\n<script>" + compare::kSortScript +
           "</script></body></html>\n";
}

}  // namespace edgewise::figures
