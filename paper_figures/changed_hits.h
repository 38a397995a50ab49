// Pixels whose rays end on another surface under another setting of tracing, and what lies around them.
#pragma once

#include <vector>

#include "paper_figures/sphere_tracing.h"
#include "paper_figures/traced_view.h"

namespace edgewise::figures {

/// Each pixel where sameHit() says no, row by row. Its kind comes from the depths that `before` has in the
/// eight pixels around it.
std::vector<ChangedHit> changedHits(const TracedView& view, const FieldSamples& before,
                                    const FieldSamples& after);

}  // namespace edgewise::figures
