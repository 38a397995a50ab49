// What this machine could do at best: memory traffic and double-precision arithmetic of all its threads.
#pragma once

#include <cstddef>
#include <string>

namespace edgewise::figures {

struct MachineRates {
    double bytes_per_second = 0.0;
    double flops_per_second = 0.0;  ///< a multiplication and an addition are two
    std::string instruction_set;    ///< of the arithmetic: "sse2", "avx2", "avx512"; "plain" elsewhere
};

/// Each the best of several runs. Bytes: a[i] = b[i] + s c[i] over three arrays of `doubles`, 24 bytes an
/// element, as STREAM counts. Flops: x = x m + a, rounded after each (the product is built without
/// contraction), in eight independent chains a thread, so that no result is waited for.
MachineRates measureMachine(std::size_t doubles, int runs);

}  // namespace edgewise::figures
