// The most memory that this process held since the last reset (Linux).
#pragma once

#include <malloc.h>

#include <fstream>
#include <string>

namespace edgewise::study {

/// Gives freed memory back and starts the count anew. False where the system does not let a process do that:
/// then the peak is that of the whole run.
inline bool resetPeakMemory() {
    malloc_trim(0);
    std::ofstream file("/proc/self/clear_refs");
    file << "5" << std::flush;
    return file.good();
}

/// MiB resident, at most; 0 where the system does not say.
inline double peakMemoryMib() {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;)
        if (double kib = 0.0; word == "VmHWM:" && file >> kib) return kib / 1024.0;
    return 0.0;
}

}  // namespace edgewise::study
