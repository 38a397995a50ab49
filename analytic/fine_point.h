// Points finer than double: a point of the grid plus a rest, so that whole pixels can be added without a
// rounding.
#pragma once

#include <cmath>
#include <cstdint>

#include "analytic/double_double.h"
#include "analytic/visible_segment.h"

namespace edgewise {

using DoubleDouble = f64::dd;

/// One coordinate of a FinePoint: grid + rest px. The rest is a multiple of 2^-76 px, so that ordinates of
/// one OrderKey are equal, and what two lines meet in differs from itself in no bit below the rounding of
/// double-double.
struct FineCoordinate {
    double grid = 0.0;
    double rest = 0.0;
};

/// p - q: its sign, and whether it is 0, are exact.
inline double difference(FineCoordinate p, FineCoordinate q) {
    return (p.grid - q.grid) + (p.rest - q.rest);
}

/// origin + offset, where origin is on the grid, rounded to 2^-76 px.
inline FineCoordinate fineCoordinate(double origin, DoubleDouble offset) {
    const double steps = std::nearbyint(offset.hi * 0x1p32) * 0x1p-32;
    return {origin + steps, std::nearbyint(((offset.hi - steps) + offset.lo) * 0x1p76) * 0x1p-76};
}

/// p - origin in double-double, exact but for the last bits of the rest; origin on the grid.
inline DoubleDouble offsetFrom(FineCoordinate p, double origin) {
    return f64::twoSum(p.grid - origin, p.rest);
}

/// Orders ordinates inside a cell: units of 2^-76 px above the grid ordinate `origin`. Ordinates that differ
/// by less are one event of the sweep. Even along the flattest edge of the grid (2^-32 px over 2^11 px) that
/// is 2^-33 px.
__extension__ typedef __int128 OrderKey;
inline OrderKey orderKey(FineCoordinate p, double origin) {
    const auto steps = static_cast<std::int64_t>((p.grid - origin) * 0x1p32);
    const auto rest = static_cast<std::int64_t>(p.rest * 0x1p76);
    return (static_cast<OrderKey>(steps) << 44) + rest;
}

inline FineCoordinate xOf(const FinePoint& p) {
    return {p.grid.x, p.rest.x};
}
inline FineCoordinate yOf(const FinePoint& p) {
    return {p.grid.y, p.rest.y};
}
inline FinePoint finePoint(FineCoordinate x, FineCoordinate y) {
    return {{x.grid, y.grid}, {x.rest, y.rest}};
}
inline bool samePoint(const FinePoint& p, const FinePoint& q) {
    return p.grid == q.grid && p.rest == q.rest;
}
inline FinePoint gridPoint(glm::dvec2 p) {
    return {p, {0.0, 0.0}};
}

/// |b - a| px, from exact grid differences.
inline double distance(const FinePoint& a, const FinePoint& b) {
    const glm::dvec2 d = (b.grid - a.grid) + (b.rest - a.rest);
    return std::hypot(d.x, d.y);
}

}  // namespace edgewise
