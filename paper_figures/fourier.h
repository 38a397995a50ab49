// The part of a finely sampled picture that coarser samples cannot hold.
#pragma once

#include <vector>

namespace edgewise::figures {

/// What is left of `values`, a square of side x side in rows, without all frequencies of at most `limit`
/// cycles a sample along both axes. Periodic beyond its border; float32 inside.
std::vector<double> beyondFrequency(const std::vector<double>& values, int side, double limit);

}  // namespace edgewise::figures
