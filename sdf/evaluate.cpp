#include "sdf/evaluate.h"

#include <cassert>

#include "sdf/dual.h"
#include "sdf/machine.h"

namespace edgewise::sdf {
namespace {

template <class R>
Slots<R>& scratch() {
    thread_local Slots<R> slots;
    return slots;
}

bool secondWins(const Instruction& i, double a, double b) {
    switch (i.code) {
        case Code::unite:
        case Code::smoothUnite:
            return b < a;
        case Code::intersect:
        case Code::smoothIntersect:
            return a < b;
        default:
            return a < -b;
    }
}

}  // namespace

double valueAt(const TapeView& tape, const glm::dvec3& p) {
    return run<double>(tape, {p.x, p.y, p.z}, scratch<double>());
}

float valueAt(const TapeView& tape, const glm::vec3& p) {
    return run<float>(tape, {p.x, p.y, p.z}, scratch<float>());
}

ValueAndGradient gradientAt(const TapeView& tape, const glm::dvec3& p) {
    const Dual x(p.x, {1, 0, 0}), y(p.y, {0, 1, 0}), z(p.z, {0, 0, 1});
    const Dual result = run<Dual>(tape, {x, y, z}, scratch<Dual>());
    return {result.value, result.slope};
}

Interval valuesIn(const TapeView& tape, const Interval (&box)[3]) {
    return run<Interval>(tape, {box[0], box[1], box[2]}, scratch<Interval>());
}

RunningError floatErrorAt(const TapeView& tape, const glm::vec3& p) {
    const RunningError x(p.x, 0.0), y(p.y, 0.0), z(p.z, 0.0);
    return run<RunningError>(tape, {x, y, z}, scratch<RunningError>());
}

const Instruction& winnerAt(const TapeView& tape, const glm::dvec3& p, glm::dvec3& p_local) {
    Slots<double>& slots = scratch<double>();
    std::array<const Instruction*, kMostSlots> winner{};
    std::array<Vec3<double>, kMostSlots> local;
    slots.position[0] = {p.x, p.y, p.z};
    tape.forEach([&](const Instruction& i, Code code) {
        const CodeForm form = kCodeForms[static_cast<int>(code)];
        const bool takes_second =
            form == CodeForm::kKeep ||
            (form == CodeForm::kPair && secondWins(i, slots.value[i.to], slots.value[i.b]));
        if (form == CodeForm::kShape) winner[i.to] = &i, local[i.to] = slots.position[i.a];
        if (takes_second) winner[i.to] = winner[i.b], local[i.to] = local[i.b];
        step(i, code, tape.numbers + i.numbers, slots);
    });
    assert(winner[0]);
    p_local = {local[0].x, local[0].y, local[0].z};
    return *winner[0];
}

glm::dvec3 localAt(const TapeView& tape, const Instruction& shape, const glm::dvec3& p) {
    Slots<double>& slots = scratch<double>();
    slots.position[0] = {p.x, p.y, p.z};
    Vec3<double> local = slots.position[0];
    tape.forEach([&](const Instruction& i, Code code) {
        if (&i == &shape) local = slots.position[i.a];
        if (kCodeForms[static_cast<int>(code)] == CodeForm::kMove)
            step(i, code, tape.numbers + i.numbers, slots);
    });
    return {local.x, local.y, local.z};
}

}  // namespace edgewise::sdf
