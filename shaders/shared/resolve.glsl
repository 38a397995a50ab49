// Of resolve.comp and what fills its tables. `bits64` is a signed 64-bit integer.

/// The weight of a sample that the filter does not reach: no sum of weights is as large.
const bits64 kUnreached = (bits64(7) << 60) + ((bits64(1) << 60) - bits64(1));
