// A kernel of the study: the product's terms, the screen and the judge.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analytic/pixel_weights.h"
#include "tests/studies/term_bounds/truth.h"

namespace edgewise::study {

struct StudyKernel {
    explicit StudyKernel(const Prefilter& prefilter, std::string kernel_name)
        : filter(prefilter),
          name(std::move(kernel_name)),
          kernel(filter),
          spots(kernel, filter),
          screen(makeScreen(filter)),
          judge(filter) {}

    Prefilter filter;
    std::string name;
    EdgeKernel kernel;
    HardSpots spots;
    std::unique_ptr<Truth<Wide>> screen;
    Judge judge;
};

/// Those that take turns. Radial: positive ones, radii from 1e-3 to 1e3 px, R/sigma from 0.1 to 40.
std::vector<std::unique_ptr<StudyKernel>> makeStudyKernels(bool radial);

}  // namespace edgewise::study
