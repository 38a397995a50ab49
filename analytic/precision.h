// In which arithmetic the terms of weights are computed.
#pragma once

namespace edgewise {

/// kFp32: distances, clip points and the order of crossings stay in double, what is integrated between the
/// clip points is float; sums are exact in either.
enum class Precision { kFp64, kFp32 };

}  // namespace edgewise
