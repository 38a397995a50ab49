#include "paper_figures/figure_plot.h"

#include <fmt/format.h>

#include "pipeline/compare/svg_pdf.h"
#include "pipeline/html_text.h"

namespace edgewise::figures {

std::string plotsHtml(std::span<const FigurePlot> plots) {
    std::string out = "<div class='plots'>\n";
    for (const FigurePlot& plot : plots) {
        std::string svg = plot.svg;  // one id a page
        for (const char* place : {"'inside", "#inside"})
            for (std::size_t at = 0; (at = svg.find(place, at)) != std::string::npos; at += plot.name.size())
                svg.replace(at + 1, 6, plot.name);
        out += fmt::format("<figure class='card'>{}<figcaption>{}</figcaption></figure>\n", svg,
                           escapedHtml(plot.caption));
    }
    return out + "</div>\n";
}

void appendPlotFiles(std::span<const FigurePlot> plots, std::vector<FigureFile>& files) {
    for (const FigurePlot& plot : plots) {
        files.push_back({plot.name + ".svg", plot.svg});
        files.push_back({plot.name + ".pdf", compare::svgPdf(plot.svg, plot.name + ".pdf")});
    }
}

}  // namespace edgewise::figures
