// The study's results for people and programs.
#pragma once

#include <string>
#include <vector>

#include "pipeline/judge/stability.h"

namespace edgewise::judge {

/// One object a row, with the fields of StabilityRow.
std::string stabilityJson(const std::vector<StabilityRow>& rows, const std::string& command);
std::string stabilityCsv(const std::vector<StabilityRow>& rows);

/// A booktabs table of the worst row of each (case, filter); of its map the ownership errors, the smaller
/// faces shown otherwise and their area, and the area error as a share of the support's square.
std::string stabilityLatex(const std::vector<StabilityRow>& rows);

/// One page that works from file://: a log-log plot of error against condition for each case, one colour a
/// filter, the promised bound dashed, and the table.
std::string stabilityHtml(const std::vector<StabilityRow>& rows, const std::string& command);

}  // namespace edgewise::judge
