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
};

std::string indexHtml(const std::vector<MadeFigure>& made, bool quick);

}  // namespace edgewise::figures
