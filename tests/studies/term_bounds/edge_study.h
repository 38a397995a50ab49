// Claims about single edges.
#pragma once

#include "tests/studies/term_bounds/study_kernel.h"
#include "tests/studies/term_bounds/term_bounds.h"

namespace edgewise::study {

using StudyKernels = std::vector<std::unique_ptr<StudyKernel>>;

/// Adds the rows of one category, and what it met.
void studyEdges(const StudyKernels& kernels, Category category, BoundsResult& result);
/// The same for triangles: alone, slivers, and fans of several; radial kernels.
void studyPolygons(const StudyKernels& kernels, Category category, BoundsResult& result);

/// The seed of one category's stream.
std::uint64_t streamSeed(const BoundsOptions& options, Category category, int stream);

}  // namespace edgewise::study
