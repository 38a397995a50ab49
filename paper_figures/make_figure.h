// One figure's folder: made, or used again.
#pragma once

#include <filesystem>

#include "paper_figures/figure.h"
#include "paper_figures/figure_stamp.h"
#include "paper_figures/index_page.h"

namespace edgewise::figures {

/// `folder` holds the figure's files and its stamp afterwards; what it holds already is used again where its
/// stamp is of the same source. A figure that fails, in whatever way, leaves the folder as it was and says
/// why. Throws Interrupted when cancelled, FailureError where the files cannot be written.
MadeFigure makeFigure(const Figure& figure, const FigureSource& source, const std::filesystem::path& folder,
                      Progress& progress);

}  // namespace edgewise::figures
