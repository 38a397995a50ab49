// The two families of the screen.
#pragma once

#include "tests/studies/term_bounds/truth.h"

namespace edgewise::study {

std::unique_ptr<Truth<Wide>> makeFanScreen(const Prefilter& filter);
std::unique_ptr<Truth<Wide>> makeStripScreen(const Prefilter& filter);

}  // namespace edgewise::study
