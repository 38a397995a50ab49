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

EDGEWISE_FN unsigned setOf(const LaneMask& m) {
    unsigned set = 0;
    for (int i = 0; i < kParts; ++i) set |= one::laneSet(m.part[i]) << (i * EDGEWISE_LANES);
    return set;
}

/// Between which values a side of a pair is in the balls.
struct Side {
    Lanes low, high;
};

class Referee {
  public:
    EDGEWISE_FN Referee(const LaneBalls& balls, const Vec3<Lanes>& centre)
        : radius_(balls.radius),
          rounding_(balls.rounding),
          size_(abs(centre.x) + abs(centre.y) + abs(centre.z) + Lanes(balls.radius)) {}

    /// As the second of a difference: -value.
    EDGEWISE_FN Side side(const Lanes& value, double slope) const {
        const Lanes reach = Lanes(slope * radius_) +
                            (size_ * Lanes(slope < 1.0 ? 1.0 : slope) + abs(value)) * Lanes(rounding_);
        return {value - reach, value + reach};
    }
    /// In which balls a is below b by more than `band`.
    static std::uint8_t below(const Side& a, const Side& b, double band) {
        return static_cast<std::uint8_t>(setOf(less(Lanes(band), b.low - a.high)));
    }

  private:
    double radius_, rounding_;
    Lanes size_;
};

EDGEWISE_FN void judge(Verdict& verdict, const Instruction& i, const double* numbers, const Referee& referee,
                       const Slots<Lanes>& s, const double* slope) {
    const bool unites = i.code == Code::unite || i.code == Code::smoothUnite;
    const bool smooth = i.code == Code::smoothUnite || i.code == Code::smoothIntersect ||
                        i.code == Code::smoothSubtract;
    verdict.negates = i.code == Code::subtract || i.code == Code::smoothSubtract;
    const double band = smooth ? numbers[0] : 0.0;
    const Side a = referee.side(s.value[i.to], slope[i.to]);
    const Side b = referee.side(verdict.negates ? -s.value[i.b] : s.value[i.b], slope[i.b]);
    const std::uint8_t first_below = Referee::below(a, b, band), second_below = Referee::below(b, a, band);
    verdict.first = unites ? first_below : second_below;
    verdict.second = unites ? second_below : first_below;
}
}  // namespace

void laneValues(const TapeView& tape, const LanePoints& p, double* values);
void laneValues(const TapeView& tape, const LanePoints& p, double* values) {
    thread_local Slots<Lanes> slots;
    Slots<Lanes>& s = slots;
    s.position[0] = Vec3<Lanes>(load(p.axis[0]), load(p.axis[1]), load(p.axis[2]));
    const double* numbers = tape.numbers;
    tape.forEach([&](const Instruction& i, Code code) __attribute__((always_inline)) {
        step(i, code, numbers + i.numbers, s);
    });
    for (int i = 0; i < kParts; ++i)
        __builtin_memcpy(values + i * EDGEWISE_LANES, &s.value[0].part[i], sizeof(one::real));
}

void laneVerdicts(const TapeView& tape, const LaneBalls& balls, Verdict* verdicts);
void laneVerdicts(const TapeView& tape, const LaneBalls& balls, Verdict* verdicts) {
    thread_local Slots<Lanes> slots;
    Slots<Lanes>& s = slots;
    double slope[kMostSlots];
    const LanePoints& p = balls.centre_world;
    s.position[0] = Vec3<Lanes>(load(p.axis[0]), load(p.axis[1]), load(p.axis[2]));
    const Referee referee(balls, s.position[0]);
    const double* numbers = tape.numbers;
    tape.forEach([&](const Instruction& i, Code code) __attribute__((always_inline)) {
        const CodeForm form = kCodeForms[static_cast<int>(code)];
        const bool asked_at = form == CodeForm::kMove || form == CodeForm::kShape;
        Verdict& verdict = *verdicts++;
        verdict = {form, false, i.to, asked_at ? i.a : i.b, 0, 0};
        if (form == CodeForm::kPair) judge(verdict, i, numbers + i.numbers, referee, s, slope);
        step(i, code, numbers + i.numbers, s);
        if (form != CodeForm::kMove) slope[i.to] = form == CodeForm::kKeep ? slope[i.b] : i.lipschitz;
    });
}

}  // namespace edgewise::sdf::EDGEWISE_ISA
