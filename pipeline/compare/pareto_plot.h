// Error against seconds, log-log: a point a method, sample counts of one method joined, and the slope that
// samplers can hope for.
#pragma once

#include <string>
#include <vector>

#include "pipeline/compare/comparison.h"

namespace edgewise::compare {

/// One <svg> that stands by itself. Errors of 0 lie on the floor, hollow. Rows without a time or an error are
/// left out.
std::string paretoSvg(const Comparison& comparison);

}  // namespace edgewise::compare
