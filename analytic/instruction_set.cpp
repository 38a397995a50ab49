#include "analytic/instruction_set.h"

#include <cstdlib>

namespace edgewise {

bool machineRuns(const std::string& instruction_set) {
    if (instruction_set == "scalar" || instruction_set == "sse2") return true;
#if defined(__x86_64__)
    if (instruction_set == "avx2") return __builtin_cpu_supports("avx2");
    if (instruction_set == "avx512")
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
#endif
    return false;
}

std::string forcedInstructionSet() {
    const char* forced = std::getenv("EDGEWISE_ISA");
    return forced ? forced : "";
}

}  // namespace edgewise
