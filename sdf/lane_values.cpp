#include <cstring>

#include "analytic/instruction_set.h"
#include "sdf/tape_lanes.h"

namespace edgewise::sdf {

#define EDGEWISE_DECLARE_VALUES(isa)                                   \
    namespace isa {                                                    \
    void laneValues(const TapeView&, const LanePoints&, double*);      \
    void laneWinners(const TapeView&, const LaneBalls&, PairWinners*); \
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

LaneWinnersFunction laneWinnersFor(const char* instruction_set) {
    if (!machineRuns(instruction_set)) return nullptr;
    const auto is = [=](const char* name) { return std::strcmp(instruction_set, name) == 0; };
    if (is("scalar")) return scalar::laneWinners;
    if (is("sse2")) return sse2::laneWinners;
#if defined(EDGEWISE_HAS_AVX)
    if (is("avx2")) return avx2::laneWinners;
    if (is("avx512")) return avx512::laneWinners;
#endif
    return nullptr;
}

void laneWinners(const TapeView& tape, const LaneBalls& balls, PairWinners* winners) {
    static const LaneWinnersFunction best = bestForm(laneWinnersFor);
    best(tape, balls, winners);
}

}  // namespace edgewise::sdf
