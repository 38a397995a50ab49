// NSAA, Figures 4 to 6: the two test patterns, and how their figures look at them.
#pragma once

#include "paper_figures/pattern_pictures.h"

namespace edgewise::figures {

/// Whole, or for `quick` a part that holds the first of the enlarged ones.
PatternPlan zonePlatePlan(bool quick);
PatternPlan logGridPlan(bool quick);

/// Figure 4's and 5's methods: msaa:2 to 16, csaa:32, smaa, nsaa with a Gaussian of radius 2.
std::vector<PatternMethod> paperMethods();

}  // namespace edgewise::figures
