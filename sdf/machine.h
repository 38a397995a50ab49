// Runs a tape with one kind of number.
#pragma once

#include <array>

#include "sdf/formulas.h"
#include "sdf/tape.h"

namespace edgewise::sdf {

/// Slots of one evaluation; reused from one to the next.
template <class R>
struct Slots {
    std::array<Vec3<R>, kMostSlots> position;
    std::array<R, kMostSlots> value;
};

/// One instruction on the slots; `code`: of a shortened tape it may be another.
template <class R>
EDGEWISE_FN void step(const Instruction& i, Code code, const double* numbers, Slots<R>& s) {
    using F = Formulas<R>;
    switch (code) {
#define EDGEWISE_SHAPE(name)                                            \
    case Code::name:                                                    \
        s.value[i.to] = applyTo<R, &F::name>(numbers, s.position[i.a]); \
        break;
#define EDGEWISE_MOVE(name)                                                \
    case Code::name:                                                       \
        s.position[i.to] = applyTo<R, &F::name>(numbers, s.position[i.a]); \
        break;
#define EDGEWISE_VALUE(name)                                          \
    case Code::name:                                                  \
        s.value[i.to] = applyTo<R, &F::name>(numbers, s.value[i.to]); \
        break;
#define EDGEWISE_VALUE_AT(name)                                                        \
    case Code::name:                                                                   \
        s.value[i.to] = applyTo<R, &F::name>(numbers, s.value[i.to], s.position[i.b]); \
        break;
#define EDGEWISE_PAIR(name)                                                         \
    case Code::name:                                                                \
        s.value[i.to] = applyTo<R, &F::name>(numbers, s.value[i.to], s.value[i.b]); \
        break;
        EDGEWISE_SDF_CODES(EDGEWISE_SHAPE, EDGEWISE_MOVE, EDGEWISE_VALUE, EDGEWISE_VALUE_AT, EDGEWISE_PAIR)
#undef EDGEWISE_SHAPE
#undef EDGEWISE_MOVE
#undef EDGEWISE_VALUE
#undef EDGEWISE_VALUE_AT
#undef EDGEWISE_PAIR
        case Code::keep:
            s.value[i.to] = s.value[i.b];
            break;
    }
}

template <class R>
EDGEWISE_FN void step(const Instruction& i, const double* numbers, Slots<R>& s) {
    step(i, i.code, numbers, s);
}

/// The value at p.
template <class R>
inline R run(const TapeView& tape, const Vec3<R>& p, Slots<R>& slots) {
    slots.position[0] = p;
    tape.forEach([&](const Instruction& i, Code code)
                     __attribute__((always_inline)) { step(i, code, tape.numbers + i.numbers, slots); });
    return slots.value[0];
}

}  // namespace edgewise::sdf
