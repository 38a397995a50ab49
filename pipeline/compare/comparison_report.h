// A comparison as one HTML page that needs nothing but itself.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/compare/comparison.h"

namespace edgewise::compare {

/// The plot, a table that sorts, two pictures side by side or in turn with one zoom, error maps with their
/// colour bars, plans and definitions. Pictures are read from `folder`, by the rows' file names, and
/// embedded; `reference_png` is the reference's, `kinds_png`, if any, the kinds of edges. Throws FailureError
/// for one that cannot be read.
std::string comparisonHtml(const Comparison& comparison, const std::filesystem::path& folder,
                           const std::string& reference_png, const std::string& kinds_png = "");

/// What other pages show of a row: the <th>s, the <td>s in their order, and a <dl> of what they mean.
std::string reportHeads();
std::string reportCells(const Row& row);
std::string reportDefinitions();

}  // namespace edgewise::compare
