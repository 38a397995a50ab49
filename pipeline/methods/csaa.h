// Where the samples of csaa:32 lie, and which of them count.
#pragma once

#include <cstdint>
#include <span>

#include "pipeline/methods/point_samples.h"

namespace edgewise {

inline constexpr int kColorSamples = 8, kCoverageSamples = 24;

/// The colour samples, at Vulkan's standard locations, then the coverage-only samples of csaa.cpp's table;
/// each of the pixel's 32 columns and of its 32 rows holds one sample of the 32. From the pixel's corner, in
/// px.
SamplePattern coverageSampledPattern();

/// Coverage-only samples hold the number of a colour sample and no colour: those that see what no colour
/// sample of their pixel sees become kUnknown. `owner` holds whole pixels in the pattern's order. Gives how
/// many became so.
std::uint64_t forgetUnstored(std::span<Owner> owner);

}  // namespace edgewise
