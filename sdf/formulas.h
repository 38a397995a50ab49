// The shared SDF text for one kind of number, and a code's function of it.
#pragma once

#include <tuple>
#include <type_traits>

#include "sdf/codes.h"
#include "sdf/real_vector.h"

namespace edgewise::sdf {

/// R: float, double, lanes of double, Dual, Interval, RunningError.
template <class R>
struct Formulas {
    using real = R;
    using vec3 = Vec3<R>;
#pragma push_macro("EDGEWISE_FN")
#undef EDGEWISE_FN
#define EDGEWISE_FN [[gnu::always_inline]] static inline
#include "shaders/shared/sdf_shapes.glsl"

#include "shaders/shared/sdf_operators.glsl"
#pragma pop_macro("EDGEWISE_FN")
};

/// Reads a function's arguments from a tape's numbers, one a real, three a vector.
template <class R>
struct NumberReader {
    const double* next;
    template <class T>
    EDGEWISE_FN T take() {
        if constexpr (std::is_same_v<T, R>) {
            return R(*next++);
        } else {
            const double* at = next;
            next += 3;
            return Vec3<R>(R(at[0]), R(at[1]), R(at[2]));
        }
    }
};

/// f(first..., numbers): how many arguments come first follows from the call.
template <class R, class Result, class A, class... Rest>
EDGEWISE_FN Result applyTo(Result (*f)(A, Rest...), const A& a, const double* numbers) {
    [[maybe_unused]] NumberReader<R> read{numbers};
    const std::tuple<Rest...> rest{read.template take<Rest>()...};  // braces: from left to right
    return std::apply([&](const Rest&... number) { return f(a, number...); }, rest);
}
template <class R, class Result, class A, class B, class... Rest>
EDGEWISE_FN Result applyTo(Result (*f)(A, B, Rest...), const A& a, const B& b, const double* numbers) {
    [[maybe_unused]] NumberReader<R> read{numbers};
    const std::tuple<Rest...> rest{read.template take<Rest>()...};
    return std::apply([&](const Rest&... number) { return f(a, b, number...); }, rest);
}

}  // namespace edgewise::sdf
