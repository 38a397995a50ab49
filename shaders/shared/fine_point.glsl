// Points finer than double, and the order of their ordinates: analytic/fine_point.h.

EDGEWISE_FN double difference(FineCoordinate p, FineCoordinate q) {
    return (p.grid - q.grid) + (p.rest - q.rest);
}

/// origin + offset, where origin is on the grid, rounded to 2^-76 px.
EDGEWISE_FN FineCoordinate fineCoordinate(double origin, dd offset) {
    double steps = nearestEven(offset.hi * EDGEWISE_REAL(4294967296.0)) * EDGEWISE_REAL(2.3283064365386963e-10);
    double rest = (offset.hi - steps) + offset.lo;
    return FineCoordinate(EDGEWISE_INIT origin + steps,
                          nearestEven(rest * EDGEWISE_REAL(7.555786372591432e+22)) *
                              EDGEWISE_REAL(1.3234889800848443e-23) EDGEWISE_END);
}

/// p - origin in double-double, exact but for the last bits of the rest; origin on the grid.
EDGEWISE_FN dd offsetFrom(FineCoordinate p, double origin) { return twoSum(p.grid - origin, p.rest); }

EDGEWISE_FN OrderKey orderKey(FineCoordinate p, double origin) {
    return keyOf((p.grid - origin) * EDGEWISE_REAL(4294967296.0), p.rest * EDGEWISE_REAL(7.555786372591432e+22));
}

EDGEWISE_FN FineCoordinate xOf(EDGEWISE_IN(FinePoint) p) {
    return FineCoordinate(EDGEWISE_INIT p.grid.x, p.rest.x EDGEWISE_END);
}
EDGEWISE_FN FineCoordinate yOf(EDGEWISE_IN(FinePoint) p) {
    return FineCoordinate(EDGEWISE_INIT p.grid.y, p.rest.y EDGEWISE_END);
}
EDGEWISE_FN FinePoint finePoint(FineCoordinate x, FineCoordinate y) {
    return FinePoint(EDGEWISE_INIT dvec2(x.grid, y.grid), dvec2(x.rest, y.rest) EDGEWISE_END);
}
EDGEWISE_FN FinePoint gridPoint(dvec2 p) {
    return FinePoint(EDGEWISE_INIT p, dvec2(EDGEWISE_REAL(0.0), EDGEWISE_REAL(0.0)) EDGEWISE_END);
}
