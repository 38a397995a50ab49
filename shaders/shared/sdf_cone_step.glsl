// Cone-traced supersampling (Chubarau et al. 2023, Algorithm 1) as a state machine: who traces asks the field at
// coneAt(state) and tells coneTake() what it said, until coneEnded(state). Where coneClosed(state), a hit group is complete:
// it is weighed and shaded, at once or later, and coneOpen() goes on.
//
// Steps may be longer than Algorithm 1's: through empty space as auto relaxation takes them (Ban and Valasek 2023), on
// what a ball of free space holds of the cone; to where the ray should meet the surface that its cone has met; and from there
// towards where the surface fills the cone.
// What such a step might have passed is asked again by Algorithm 1's.
//
// C++ compiles this text as double, GLSL as float. Distances are f / L.

const int kConeGoes = 0;
const int kConeFull = 1;   // the cone is within the solid, or the rest of it needs no looking
const int kConeFar = 2;    // nothing up to t_max

struct ConeRules {
    real t_max;
    real radius;     ///< the cone's radius is radius + slope * t: through the corners of a pixel, times the coverage
    real slope;
    real alpha;      ///< the least step, of the cone's radius: below 1, so that no hit is stepped over
    real hard;       ///< a hit is hard where the distance is below this part of the cone's radius
    bool relaxed;    ///< CTSS-R: ends at the first hard hit
    bool backtrace;  ///< section 3.6
    bool overstep;   ///< longer steps than Algorithm 1's
};

struct ConeState {
    real t;        ///< the field is asked there next
    real safe_t;   ///< nothing of the surface lies between the last point asked and this
    real last_t;   ///< the last point asked, but for those whose step is taken back
    real value;    ///< f / L there
    real slope;    ///< in a group: of the distance; else, smoothed, of how far the cone is free
    real wall;     ///< no longer step goes beyond: the cone meets something there
    real entry_t;  ///< of the open group: where the cone meets it
    real hard_t;   ///< where the ray does
    real least;    ///< of the open group: the least distance, in radii of the cone
    bool longer;   ///< the step to t is
    bool missed;   ///< in a group: a longer step was taken back
    bool open;
    bool hard;
    bool closed;   ///< a group is complete: entry_t, hard_t, least and hard are its
    int end;
};

EDGEWISE_FN real coneRadiusAt(ConeRules rules, real t) {
    return rules.radius + rules.slope * t;
}
EDGEWISE_FN ConeState coneFrom(ConeRules rules, real t_min) {
    ConeState s;
    s.t = t_min;
    s.safe_t = t_min;
    s.last_t = t_min;
    s.value = real(0.0);
    s.slope = real(-1.0);
    s.wall = rules.t_max;
    s.longer = false;
    s.missed = false;
    s.entry_t = t_min;
    s.hard_t = t_min;
    s.least = real(1.0);
    s.open = false;
    s.hard = false;
    s.closed = false;
    s.end = t_min < rules.t_max ? kConeGoes : kConeFar;
    return s;
}
EDGEWISE_FN bool coneEnded(ConeState s) {
    return s.end != kConeGoes;
}
EDGEWISE_FN real coneAt(ConeState s) {
    return s.t;
}

/// Equation 10: where the cone's base, its own radius before t, meets nothing that was not met at the last point.
EDGEWISE_FN real coneEntry(ConeRules rules, ConeState s) {
    real safe = (s.t - rules.radius) / (real(1.0) + rules.slope);
    return rules.backtrace ? max(safe, s.last_t) : s.t;
}

/// Where the group is shaded: the ray's own hit, else where the cone comes upon the surface, which faces the eye there.
EDGEWISE_FN real coneSampleAt(ConeState s) {
    return s.hard ? s.hard_t : s.entry_t;
}

/// Algorithm 1's step.
EDGEWISE_FN real coneLeastStep(ConeRules rules, real t, real value) {
    return max(value, rules.alpha * coneRadiusAt(rules, t));
}

/// How far up the ray a ball of radius `value` at t holds the cone; 0: it does not hold it at t. Its rim is in the ball up
/// to where x^2 + (R + slope x)^2 = value^2. Down the ray it is a little farther: the cone is narrower there.
EDGEWISE_FN real coneFree(ConeRules rules, real t, real value) {
    real radius = coneRadiusAt(rules, t);
    real m = real(1.0) + rules.slope * rules.slope;
    real rest = m * value * value - radius * radius;
    return value > radius ? max((sqrt(rest) - radius * rules.slope) / m, real(0.0)) : real(0.0);
}

/// Whether a long step has passed nothing: outside of groups, two balls that meet beyond the cone's rim have it all between
/// them. Within one, the distance fell by half of what it should, and could not rise to the cone's radius in between; and
/// before the ray has met the surface, two balls hold the ray, or it meets the surface at the end.
EDGEWISE_FN bool conePassedNothing(ConeRules rules, ConeState s, real value) {
    real step = s.t - s.last_t;
    real radius = coneRadiusAt(rules, s.last_t);
    bool fell = value <= s.value + real(0.5) * s.slope * step;
    if (s.open) {
        bool lands = value >= real(0.0) && value <= rules.hard * coneRadiusAt(rules, s.t);
        bool met = s.hard || lands || s.value + value >= step;
        return fell && met && s.value + value + step < real(2.0) * radius;
    }
    if (!(value > coneRadiusAt(rules, s.t))) return false;
    return coneFree(rules, s.last_t, s.value) + coneFree(rules, s.t, value) >= step;
}

/// Where the field is met below the cone's radius, it is so around there as well.
EDGEWISE_FN ConeState coneTakeBack(ConeRules rules, ConeState s, real value) {
    real radius = coneRadiusAt(rules, s.t);
    if (!s.open && value < radius) s.wall = min(s.wall, s.t + value - radius);
    s.missed = s.open;
    s.slope = s.open ? real(0.0) : real(-1.0);
    s.closed = false;
    s.longer = false;
    s.t = s.last_t + coneLeastStep(rules, s.last_t, s.value);
    return s;
}

/// From the point just asked. Two balls that touch the same plane and each
/// other: r and r + m d, d apart; d = 2 r / (1 - m). Within a surface: a little before where the ray meets a plane, then a
/// little beyond where that fills the cone, but so that the distance could not rise to the radius in between.
EDGEWISE_FN real coneStep(ConeRules rules, ConeState s, real t, real value) {
    real least = coneLeastStep(rules, t, value), radius = coneRadiusAt(rules, t);
    if (!rules.overstep) return least;
    if (!s.open) {
        real step = real(2.0) * coneFree(rules, t, value) / max(real(1.0) - s.slope, real(1e-6));
        return max(min(step, s.wall - t), least);
    }
    if (!(s.slope < real(0.0))) return least;
    real kept = real(1.9375) * (radius - value) / max(real(1.0) + s.slope, real(1e-6));
    if (s.hard) return max(min(real(1.0625) * (value + radius) / -s.slope, kept), least);
    real met = (value - real(0.5) * rules.hard * radius) / -s.slope;
    if (met <= kept && !s.missed) return max(met, least);
    return max(min(real(2.0) * value / (real(1.0) - s.slope), kept), least);
}

/// On the way to the point just asked, for steps from there.
EDGEWISE_FN real coneSlope(ConeRules rules, ConeState s, real value, bool soft) {
    real way = s.t - s.last_t;
    if (!(way > real(0.0)) || (s.open && !soft)) return real(-1.0);
    if (soft) return (value - s.value) / way;
    real slope = (coneFree(rules, s.t, value) - coneFree(rules, s.last_t, s.value)) / way;
    return s.slope + real(0.5) * (max(slope, real(-1.0)) - s.slope);
}

/// `value`: f / L at coneAt(s), times the ray's sign.
EDGEWISE_FN ConeState coneTake(ConeRules rules, ConeState s, real value) {
    if (s.longer && !conePassedNothing(rules, s, value)) return coneTakeBack(rules, s, value);
    real radius = coneRadiusAt(rules, s.t);
    real share = value / radius;
    bool soft = share < real(1.0);
    s.slope = coneSlope(rules, s, value, soft);
    if (soft && !s.open) {
        s.entry_t = coneEntry(rules, s);
        s.least = real(1.0);
        s.hard = false;
        s.missed = false;
    }
    s.closed = s.open && !soft;
    if (soft) {
        s.least = min(s.least, share);
        if (!s.hard && share < rules.hard) {
            s.hard_t = rules.backtrace && !s.longer ? min(s.safe_t, s.t) : s.t;
            s.hard = true;
        }
    }
    s.open = soft;
    bool full = share <= real(-1.0) || (rules.relaxed && s.hard && soft);
    real least = coneLeastStep(rules, s.t, value);
    real step = coneStep(rules, s, s.t, value);
    if (full) {
        s.end = kConeFull;
    } else if (s.t + least >= rules.t_max) {
        s.end = kConeFar;
    }
    if (s.end != kConeGoes) s.closed = s.closed || s.open;
    s.safe_t = s.t + max(value, real(0.0));
    s.last_t = s.t;
    s.value = value;
    s.t = s.t + step;
    s.longer = step > least;
    return s;
}

/// Out of steps: what is open is as complete as it gets.
EDGEWISE_FN ConeState coneStopped(ConeState s) {
    if (s.end != kConeGoes) return s;
    s.end = kConeFar;
    s.closed = s.closed || s.open;
    return s;
}

/// The closed group's least distance in radii. What fills the cone fills the mask, whose points may lie outside of the cone.
EDGEWISE_FN real coneLeast(ConeState s) {
    return s.end == kConeFull && s.least <= real(-1.0) ? real(-2.0) : s.least;
}

/// The part of the cone's base that a group covers: of a plane whose normal's share across the ray is (nx, ny), as bits of
/// a mask; bit row * columns + column (the corners of 6 x 6 left out) is a point of the square around the base. `distance`:
/// of the plane from the middle, in radii (equation 8 with a normal of length 1; d_eff of the group's greatest occlusion).
EDGEWISE_FN uint planeMask(real nx, real ny, real distance, bool four_by_eight) {
    int columns = four_by_eight ? 8 : 6;
    int rows = four_by_eight ? 4 : 6;
    real size = sqrt(nx * nx + ny * ny);
    real ux = size > real(0.0) ? nx / size : real(1.0);
    real uy = size > real(0.0) ? ny / size : real(0.0);
    uint mask = 0u;
    uint bit = 1u;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            bool corner = !four_by_eight && (row == 0 || row == 5) && (column == 0 || column == 5);
            if (corner) continue;
            real x = real(2.0) * (real(column) + real(0.5)) / real(columns) - real(1.0);
            real y = real(2.0) * (real(row) + real(0.5)) / real(rows) - real(1.0);
            if (ux * x + uy * y + distance < real(0.0)) mask = mask | bit;
            bit = bit << 1;
        }
    }
    return mask;
}
