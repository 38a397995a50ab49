#include "pipeline/surface_lanes.h"

#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace edgewise {

#define EDGEWISE_DECLARE_SURFACES(isa)                                                                  \
    namespace surface_lanes::isa {                                                                      \
    void spread(const LaneTriangle&, int, SurfaceLanes&);                                               \
    void locate(const LaneFrame&, const SurfaceLanes&, int, LanePlaces&);                               \
    unsigned shade(const LaneFrame&, const LaneMaterial&, bool, const SurfaceLanes&, int, LaneColors&); \
    }
EDGEWISE_DECLARE_SURFACES(scalar)
EDGEWISE_DECLARE_SURFACES(sse2)
#if defined(EDGEWISE_HAS_AVX)
EDGEWISE_DECLARE_SURFACES(avx2)
EDGEWISE_DECLARE_SURFACES(avx512)
#endif

SurfaceFunctions surfaceFunctionsFor(const char* instruction_set) {
    using namespace surface_lanes;
    const auto is = [=](const char* name) { return std::strcmp(instruction_set, name) == 0; };
    if (is("scalar")) return {scalar::spread, scalar::locate, scalar::shade};
    if (is("sse2")) return {sse2::spread, sse2::locate, sse2::shade};
#if defined(EDGEWISE_HAS_AVX)
    if (is("avx2") && __builtin_cpu_supports("avx2")) return {avx2::spread, avx2::locate, avx2::shade};
    if (is("avx512") && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        return {avx512::spread, avx512::locate, avx512::shade};
#endif
    return {nullptr, nullptr, nullptr};
}

SurfaceFunctions chooseSurfaceFunctions() {
    if (const char* forced = std::getenv("EDGEWISE_ISA"); forced && *forced) {
        if (const SurfaceFunctions functions = surfaceFunctionsFor(forced); functions.shade) return functions;
        throw std::invalid_argument("EDGEWISE_ISA: this machine has no '" + std::string(forced) + "'");
    }
    for (const char* name : {"avx512", "avx2", "sse2"})
        if (const SurfaceFunctions functions = surfaceFunctionsFor(name); functions.shade) return functions;
    return surfaceFunctionsFor("scalar");
}

}  // namespace edgewise
