// The results of a sweep as one HTML page that needs nothing but itself.
#pragma once

#include <string>

#include "pipeline/sweep/sweep_results.h"

namespace edgewise::sweep {

/// A part for each machine: error against seconds, a plot a job, and a table of all rows that sorts.
std::string resultsHtml(const SweepResults& results);

}  // namespace edgewise::sweep
