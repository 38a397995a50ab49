// What a run tells about itself: --stats as JSON, --explain in words.
#pragma once

#include <string>
#include <vector>

#include "pipeline/methods/method.h"

namespace edgewise::cli {

/// {"stages": {name: seconds}, "counts": {}, "peak_mib": x, "plan": [{"stage", "runs", "why"}], ...}, with
/// the peak of this process so far.
std::string statisticsJson(const MethodResult& result);

/// One line a stage: whether it runs, and why.
std::string planInWords(const std::vector<PlanEntry>& plan);

}  // namespace edgewise::cli
