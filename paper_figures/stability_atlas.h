// The stability atlas: how much of what is promised stiff and extreme cases use up.
#pragma once

#include <string>
#include <vector>

#include "paper_figures/figure_plot.h"
#include "pipeline/judge/stability.h"

namespace edgewise::figures {

/// The worst of a case with a filter over all difficulties.
struct AtlasCell {
    std::string case_name, filter;
    double of_bound = 0.0, of_float_bound = 0.0;  ///< largest error over what is promised: fp64, fp32
    double at = 0.0;                              ///< the difficulty of the fp64 error that comes nearest
    double max_error = 0.0, max_float_error = 0.0;
    std::size_t ownership_errors = 0;  ///< of weights and maps, both precisions
    bool kept = true;                  ///< every promise
};

/// By case and filter in the rows' order.
std::vector<AtlasCell> atlasCells(const std::vector<judge::StabilityRow>& rows);

/// Cases down, filters and precisions across.
FigurePlot atlasPlot(const std::vector<AtlasCell>& cells);
/// Errors against each case's condition, in order of stabilityCases(); cases without rows are left out.
std::vector<FigurePlot> stabilityPlots(const std::vector<judge::StabilityRow>& rows);

}  // namespace edgewise::figures
