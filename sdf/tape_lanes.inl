// laneValues() for one instruction set: define EDGEWISE_ISA (a namespace) and EDGEWISE_LANES (1, 2, 4 or 8), then include.
// Nothing here may call an inline function of another namespace but templates of `Lanes`, which this file has to itself.
#include "analytic/shared_text.h"
#include "sdf/machine.h"
#include "sdf/tape_lanes.h"

#if defined(__x86_64__) && EDGEWISE_LANES > 1
#include <immintrin.h>
#define EDGEWISE_X86
#endif

namespace edgewise::sdf::EDGEWISE_ISA {
namespace {
namespace one {
#include "analytic/real_lanes.h"

EDGEWISE_FN real absOf(real x) { return x < splat(0.0) ? -x : x + splat(0.0); }
#if EDGEWISE_LANES == 1
EDGEWISE_FN real floorOf(real x) { return __builtin_floor(x); }
#elif defined(EDGEWISE_X86) && EDGEWISE_LANES == 8
EDGEWISE_FN real floorOf(real x) { return _mm512_floor_pd(x); }
#elif defined(EDGEWISE_X86) && EDGEWISE_LANES == 4
EDGEWISE_FN real floorOf(real x) { return _mm256_floor_pd(x); }
#else
EDGEWISE_FN real floorOf(real x) {
    real whole;
    for (int i = 0; i < EDGEWISE_LANES; ++i) whole[i] = __builtin_floor(x[i]);
    return whole;
}
#endif
}  // namespace one

constexpr int kParts = kPointLanes / EDGEWISE_LANES;

struct LaneMask {
    one::mask part[kParts];
};

/// Eight numbers, in as many registers as they need.
struct Lanes {
    one::real part[kParts];
    Lanes() = default;
    // Part by part: as a block of memory it would be copied in pieces that loads of whole parts must wait for.
    EDGEWISE_FN Lanes(const Lanes& other) {
        for (int i = 0; i < kParts; ++i) part[i] = other.part[i];
    }
    EDGEWISE_FN Lanes& operator=(const Lanes& other) {
        for (int i = 0; i < kParts; ++i) part[i] = other.part[i];
        return *this;
    }
    EDGEWISE_FN explicit Lanes(double number) {
        for (one::real& p : part) p = one::splat(number);
    }
};

template <class F>
EDGEWISE_FN Lanes each(const Lanes& a, F f) {
    Lanes out;
    for (int i = 0; i < kParts; ++i) out.part[i] = f(a.part[i]);
    return out;
}
template <class F>
EDGEWISE_FN Lanes each(const Lanes& a, const Lanes& b, F f) {
    Lanes out;
    for (int i = 0; i < kParts; ++i) out.part[i] = f(a.part[i], b.part[i]);
    return out;
}
using one::real;
EDGEWISE_FN Lanes operator+(const Lanes& a, const Lanes& b) {
    return each(a, b, [](real x, real y) __attribute__((always_inline)) { return x + y; });
}
EDGEWISE_FN Lanes operator-(const Lanes& a, const Lanes& b) {
    return each(a, b, [](real x, real y) __attribute__((always_inline)) { return x - y; });
}
EDGEWISE_FN Lanes operator*(const Lanes& a, const Lanes& b) {
    return each(a, b, [](real x, real y) __attribute__((always_inline)) { return x * y; });
}
EDGEWISE_FN Lanes operator/(const Lanes& a, const Lanes& b) {
    return each(a, b, [](real x, real y) __attribute__((always_inline)) { return x / y; });
}
EDGEWISE_FN Lanes operator-(const Lanes& a) {
    return each(a, [](real x) __attribute__((always_inline)) { return -x; });
}
EDGEWISE_FN Lanes square(const Lanes& a) { return a * a; }
EDGEWISE_FN Lanes sqrt(const Lanes& a) {
    return each(a, [](real x) __attribute__((always_inline)) { return one::sqrt(x); });
}
EDGEWISE_FN Lanes abs(const Lanes& a) {
    return each(a, [](real x) __attribute__((always_inline)) { return one::absOf(x); });
}
EDGEWISE_FN Lanes floor(const Lanes& a) {
    return each(a, [](real x) __attribute__((always_inline)) { return one::floorOf(x); });
}
EDGEWISE_FN Lanes min(const Lanes& a, const Lanes& b) {
    return each(a, b, [](real x, real y) __attribute__((always_inline)) { return y < x ? y : x; });
}
EDGEWISE_FN Lanes max(const Lanes& a, const Lanes& b) {
    return each(a, b, [](real x, real y) __attribute__((always_inline)) { return x < y ? y : x; });
}
EDGEWISE_FN LaneMask less(const Lanes& a, const Lanes& b) {
    LaneMask out;
    for (int i = 0; i < kParts; ++i) out.part[i] = a.part[i] < b.part[i];
    return out;
}
EDGEWISE_FN Lanes choose(const LaneMask& condition, const Lanes& a, const Lanes& b) {
    Lanes out;
    for (int i = 0; i < kParts; ++i) out.part[i] = condition.part[i] ? a.part[i] : b.part[i];
    return out;
}

namespace text {
using real = Lanes;
#include "shaders/shared/sdf_sine.glsl"
}  // namespace text
EDGEWISE_FN Lanes sine(const Lanes& x) { return text::sine(x); }
EDGEWISE_FN Lanes cosine(const Lanes& x) { return text::cosine(x); }

EDGEWISE_FN Lanes load(const double* numbers) {
    Lanes lanes;
    for (int i = 0; i < kParts; ++i)
        __builtin_memcpy(&lanes.part[i], numbers + i * EDGEWISE_LANES, sizeof lanes.part[i]);
    return lanes;
}
}  // namespace

void laneValues(const Instruction* begin, const Instruction* end, const double* numbers, const LanePoints& p,
                double* values);
void laneValues(const Instruction* begin, const Instruction* end, const double* numbers, const LanePoints& p,
                double* values) {
    thread_local Slots<Lanes> slots;
    Slots<Lanes>& s = slots;
    s.position[0] = Vec3<Lanes>(load(p.axis[0]), load(p.axis[1]), load(p.axis[2]));
    for (const Instruction* i = begin; i != end; ++i) step(*i, numbers + i->numbers, s);
    for (int i = 0; i < kParts; ++i)
        __builtin_memcpy(values + i * EDGEWISE_LANES, &s.value[0].part[i], sizeof(one::real));
}

}  // namespace edgewise::sdf::EDGEWISE_ISA
