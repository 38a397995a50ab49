// Runs of like children in a tape: what becomes a loop over a table.
#pragma once

#include <vector>

#include "sdf/tape.h"

namespace edgewise::sdf {

/// `rows` blocks of `length` instructions from `first` on, one after the other: each makes a child's value
/// and ends with the pair that folds it in. They have the same codes, slots and pair numbers.
struct TapeBatch {
    std::size_t first = 0, length = 0, rows = 0;
    std::size_t end() const { return first + length * rows; }
};

/// Smaller runs stay straight-line.
struct BatchRule {
    std::size_t least_rows = 16;
    std::size_t least_instructions = 0;  ///< of all rows together
};

/// In the tape's order; none lies within another: the outer ones win.
std::vector<TapeBatch> findBatches(const Tape& tape, const BatchRule& rule);

}  // namespace edgewise::sdf
