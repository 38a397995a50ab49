// A row's errors, against the reference of its filter.
#pragma once

#include "pipeline/compare/comparison.h"
#include "pipeline/compare/schedule.h"

namespace edgewise::compare {

/// Fills error, bias_half_width and, with a reference that knows its edges, few_edges or kinds. Throws
/// InputError as judge::compareImages() does.
void judgeRow(Row& row, const ImageBuffer& picture, const ReferencePicture& reference);

}  // namespace edgewise::compare
