// The error of a product's number against the truth, in u = 2^-53: one text for the screen's and the judge's
// numbers.
#pragma once

#include <cmath>
#include <limits>

#include "tests/studies/term_bounds/observed_terms.h"
#include "tests/studies/term_bounds/truth.h"

namespace edgewise::study {

inline constexpr double kU = 0x1p-53;

template <class Number>
Number fromFixed(std::int64_t value) {
    if constexpr (std::is_same_v<Number, Wide>)
        return wideFrom(value) * Wide(0x1p-60);
    else
        return Number(value) * Number(0x1p-60);
}

/// |found - truth| / |truth|; a truth of 0 must be found exactly.
template <class Number>
double relativeError(const Number& found, const Number& truth) {
    const double size = std::abs(static_cast<double>(truth));
    const double off = std::abs(static_cast<double>(Number(found - truth)));
    if (size == 0) return off == 0 ? 0 : std::numeric_limits<double>::infinity();
    return off / size / kU;
}

/// |found - truth| modulo the whole border.
template <class Number>
double wrappedError(const Number& found, const Number& truth) {
    const Number off = found - truth;
    const double turns = std::nearbyint(static_cast<double>(off));
    return std::abs(static_cast<double>(Number(off - Number(turns)))) / kU;
}

/// Both ends inside: the term, before its rounding, against the whole fan.
template <class Number>
double insideError(const Truth<Number>& truth, const Edge& edge, const ObservedTerm& seen) {
    return relativeError<Number>(Number(seen.term), truth.total(edge));
}

/// Clipped: the term, before its rounding, between the points where the code cut the line.
template <class Number>
double pieceError(const Truth<Number>& truth, const Edge& edge, const ObservedTerm& seen) {
    return relativeError<Number>(Number(seen.term), truth.piece(edge, seen.t1, seen.t2));
}

/// All that the edge gives to its left owner, crossings included, in fixed point. The ends that count as
/// outside stand on the border themselves: F_in + entry - exit = F(a, b) + [a outside] position(a) - [b
/// outside] position(b).
template <class Number>
double settledError(const Truth<Number>& truth, const Edge& edge, const ObservedTerm& seen, bool a_out,
                    bool b_out) {
    Number found = fromFixed<Number>(seen.fixed.value[0]), exact = truth.total(edge);
    if (seen.entered) found = found + fromFixed<Number>(seen.fixed.position[0][0]);
    if (seen.left) found = found - fromFixed<Number>(seen.fixed.position[1][0]);
    if (a_out) exact = exact + truth.position(edge.a);
    if (b_out) exact = exact - truth.position(edge.b);
    return wrappedError<Number>(found, exact);
}

}  // namespace edgewise::study
