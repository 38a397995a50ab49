#include <cstring>

#include "analytic/instruction_set.h"
#include "sdf/tape_lanes.h"

namespace edgewise::sdf {

#define EDGEWISE_DECLARE_VALUES(isa)                                \
    namespace isa {                                                 \
    void laneValues(const TapeView&, const LanePoints&, double*);   \
    void laneVerdicts(const TapeView&, const LaneBalls&, Verdict*); \
    }
EDGEWISE_DECLARE_VALUES(scalar)
EDGEWISE_DECLARE_VALUES(sse2)
#if defined(EDGEWISE_HAS_AVX)
EDGEWISE_DECLARE_VALUES(avx2)
EDGEWISE_DECLARE_VALUES(avx512)
#endif

LaneValuesFunction laneValuesFor(const char* instruction_set) {
    if (!machineRuns(instruction_set)) return nullptr;
    const auto is = [=](const char* name) { return std::strcmp(instruction_set, name) == 0; };
    if (is("scalar")) return scalar::laneValues;
    if (is("sse2")) return sse2::laneValues;
#if defined(EDGEWISE_HAS_AVX)
    if (is("avx2")) return avx2::laneValues;
    if (is("avx512")) return avx512::laneValues;
#endif
    return nullptr;
}

void laneValues(const TapeView& tape, const LanePoints& p, double (&values)[kPointLanes]) {
    static const LaneValuesFunction best = bestForm(laneValuesFor);
    best(tape, p, values);
}

LaneVerdictsFunction laneVerdictsFor(const char* instruction_set) {
    if (!machineRuns(instruction_set)) return nullptr;
    const auto is = [=](const char* name) { return std::strcmp(instruction_set, name) == 0; };
    if (is("scalar")) return scalar::laneVerdicts;
    if (is("sse2")) return sse2::laneVerdicts;
#if defined(EDGEWISE_HAS_AVX)
    if (is("avx2")) return avx2::laneVerdicts;
    if (is("avx512")) return avx512::laneVerdicts;
#endif
    return nullptr;
}

void laneVerdicts(const TapeView& tape, const LaneBalls& balls, Verdict* verdicts) {
    static const LaneVerdictsFunction best = bestForm(laneVerdictsFor);
    best(tape, balls, verdicts);
}

}  // namespace edgewise::sdf
