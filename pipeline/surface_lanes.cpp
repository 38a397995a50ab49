#include "pipeline/surface_lanes.h"

#include <cstring>

#include "analytic/instruction_set.h"

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
    if (!machineRuns(instruction_set)) return {};
    const auto is = [=](const char* name) { return std::strcmp(instruction_set, name) == 0; };
    if (is("scalar")) return {scalar::spread, scalar::locate, scalar::shade};
    if (is("sse2")) return {sse2::spread, sse2::locate, sse2::shade};
#if defined(EDGEWISE_HAS_AVX)
    if (is("avx2")) return {avx2::spread, avx2::locate, avx2::shade};
    if (is("avx512")) return {avx512::spread, avx512::locate, avx512::shade};
#endif
    return {};
}

SurfaceFunctions chooseSurfaceFunctions() {
    return bestForm(surfaceFunctionsFor);
}

}  // namespace edgewise
