// The page that joins the figures of a folder.
#pragma once

#include <string>
#include <vector>

#include "paper_figures/figure.h"

namespace edgewise::figures {

struct MadeFigure {
    const Figure* figure;
    std::string page;  ///< relative to the index; empty where it failed
    std::string why;   ///< it failed
    std::vector<FigureClaim> claims = {};
    double seconds = 0.0;  ///< that it took, when it was made
    bool quick = false, reused = false;
    bool of_this_program = true;  ///< else it lies there from another build
};

std::string indexHtml(const std::vector<MadeFigure>& made);
/// The claims of all figures.
std::string indexCsv(const std::vector<MadeFigure>& made);

}  // namespace edgewise::figures
