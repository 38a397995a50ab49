// The shared SDF text for one kind of number, and a code's function of it.
#pragma once

#include <type_traits>
#include <utility>

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

/// A function's arguments from a tape's numbers, one a real, three a vector.
template <class R, class T>
EDGEWISE_FN T numberAt(const double* at) {
    if constexpr (std::is_same_v<T, R>)
        return R(*at);
    else
        return Vec3<R>(R(at[0]), R(at[1]), R(at[2]));
}
template <class R, class... T>
struct NumberOffsets {
    int of[sizeof...(T) + 1] = {};
    constexpr NumberOffsets() {
        [[maybe_unused]] int n = 0, offset = 0;
        ((of[n++] = offset, offset += std::is_same_v<T, R> ? 1 : 3), ...);
    }
};

template <class R, auto kFunction, class... Rest, std::size_t... I, class... First>
EDGEWISE_FN auto applyRest([[maybe_unused]] const double* numbers, std::index_sequence<I...>,
                           const First&... first) {
    [[maybe_unused]] constexpr NumberOffsets<R, Rest...> kOffsets;
    return kFunction(first..., numberAt<R, Rest>(numbers + kOffsets.of[I])...);
}
/// kFunction(first..., numbers): how many arguments come first follows from the call. All of it is known
/// when it is compiled, so that the function's text lies where it is called.
template <class R, auto kFunction, class Result, class A, class... Rest>
EDGEWISE_FN Result applyOne(Result (*)(A, Rest...), const double* numbers, const A& a) {
    return applyRest<R, kFunction, Rest...>(numbers, std::index_sequence_for<Rest...>(), a);
}
template <class R, auto kFunction, class Result, class A, class B, class... Rest>
EDGEWISE_FN Result applyTwo(Result (*)(A, B, Rest...), const double* numbers, const A& a, const B& b) {
    return applyRest<R, kFunction, Rest...>(numbers, std::index_sequence_for<Rest...>(), a, b);
}
template <class R, auto kFunction, class A>
EDGEWISE_FN auto applyTo(const double* numbers, const A& a) {
    return applyOne<R, kFunction>(kFunction, numbers, a);
}
template <class R, auto kFunction, class A, class B>
EDGEWISE_FN auto applyTo(const double* numbers, const A& a, const B& b) {
    return applyTwo<R, kFunction>(kFunction, numbers, a, b);
}

}  // namespace edgewise::sdf
