// A figure's plots: on its page, and as files for papers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "paper_figures/figure.h"

namespace edgewise::figures {

struct FigurePlot {
    std::string name, caption, svg;
};

/// A grid of <figure>s; kPlotStyle is theirs.
std::string plotsHtml(std::span<const FigurePlot> plots);

inline constexpr const char* kPlotStyle = R"css(
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(560px,1fr));gap:14px;margin-bottom:14px}
figure{margin:0}figcaption{font-size:13px;color:#444;margin-top:4px}
.plots .card svg{max-width:none}
)css";

/// NAME.svg and NAME.pdf of each. Throws FailureError where a PDF cannot be made.
void appendPlotFiles(std::span<const FigurePlot> plots, std::vector<FigureFile>& files);

}  // namespace edgewise::figures
