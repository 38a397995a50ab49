// Cone-traced supersampling (Chubarau et al. 2023, Algorithm 1) as a state machine: who traces asks the field at
// coneAt(state) and tells coneTake() what it said, until coneEnded(state). Where coneClosed(state), a hit group is complete:
// it is weighed and shaded, at once or later, and coneOpen() goes on.
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
};

struct ConeState {
    real t;        ///< the field is asked there next
    real safe_t;   ///< nothing of the surface lies between the last point asked and this
    real last_t;   ///< the last point asked
    real entry_t;  ///< of the open group: where the cone meets it
    real hard_t;   ///< where the ray does
    real least;    ///< of the open group: the least distance, in radii of the cone
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

EDGEWISE_FN ConeState coneTake(ConeRules rules, ConeState s, real value) {
    real radius = coneRadiusAt(rules, s.t);
    real share = value / radius;
    bool soft = share < real(1.0);
    if (soft && !s.open) {
        s.entry_t = coneEntry(rules, s);
        s.least = real(1.0);
        s.hard = false;
    }
    s.closed = s.open && !soft;
    if (soft) {
        s.least = min(s.least, share);
        if (!s.hard && share < rules.hard) {
            s.hard_t = rules.backtrace ? min(s.safe_t, s.t) : s.t;
            s.hard = true;
        }
    }
    s.open = soft;
    bool full = share <= real(-1.0) || (rules.relaxed && s.hard && soft);
    real next = s.t + max(value, rules.alpha * radius);
    if (full) {
        s.end = kConeFull;
    } else if (next >= rules.t_max) {
        s.end = kConeFar;
    }
    if (s.end != kConeGoes) s.closed = s.closed || s.open;
    s.safe_t = s.t + max(value, real(0.0));
    s.last_t = s.t;
    s.t = next;
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
