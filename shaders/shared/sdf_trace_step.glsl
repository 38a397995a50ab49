// Sphere tracing as a state machine: who traces asks the field at traceAt(state), and tells traceTake() what it said,
// until traceEnded(state). All relaxations fail alike: where the unbounding spheres of two points do not overlap, the
// farther point is forgotten and the ray goes on from the nearer one, so that no surface is stepped over.
//
// C++ compiles this text as double, GLSL as float.

const int kRelaxNone = 0;     // Hart 1996
const int kRelaxKeinert = 1;  // Keinert et al. 2014, Listing 2
const int kRelaxBalint = 2;   // Balint and Valasek 2018
const int kRelaxAuto = 3;     // Ban and Valasek 2023

const int kRayGoes = 0;
const int kRayHit = 1;   // within the threshold
const int kRayFar = 2;   // nothing up to t_max

/// What Balint and Valasek step of what a plane would allow beyond a sphere's radius.
const real kBalintShare = real(0.9);
/// How much of auto's slope each step replaces. Ban and Valasek's 0.3 is best where failed steps are forgotten; here they
/// cost less, so that omega may follow faster.
const real kAutoShare = real(0.5);

struct TraceRules {
    int relaxation;
    real omega;         ///< Keinert's
    real t_max;
    real pixel_radius;  ///< the pixel's radius is pixel_radius + pixel_slope * t
    real pixel_slope;
    real threshold;     ///< of the pixel's radius
    real lift;          ///< level set: `threshold`; else 0. lift * radius is added to distances
};

struct TraceState {
    real t;                ///< nothing lies between the ray's start and t + radius
    real radius;           ///< of the unbounding sphere at t
    real value;            ///< f / L at t, not lifted
    real step;             ///< the field is asked at t + step next
    real omega;            ///< Keinert's: 1 once a step failed
    real slope;            ///< auto: smoothed, of the radius along the ray
    real candidate_t;      ///< the point nearest to a surface in pixels,
    real candidate_value;  ///< f / L there,
    real candidate_error;  ///< and the sphere's radius there in radii of a pixel
    real far_t;            ///< auto: where the last step that failed led,
    real far_value;        ///< f / L there,
    real wall;             ///< and beyond which no step goes: it lies behind a surface
    int end;
    int failed;            ///< steps taken back
};

EDGEWISE_FN real pixelRadiusAt(TraceRules rules, real t) {
    return rules.pixel_radius + rules.pixel_slope * t;
}

EDGEWISE_FN TraceState traceFrom(TraceRules rules, real t_min) {
    TraceState s;
    s.t = t_min;
    s.radius = real(0.0);
    s.value = real(0.0);
    s.step = real(0.0);
    s.omega = rules.omega;
    s.slope = real(-1.0);
    s.candidate_t = t_min;
    s.candidate_value = real(0.0);
    s.candidate_error = real(1e30);
    s.far_t = t_min;
    s.far_value = real(0.0);
    s.wall = rules.t_max;
    s.end = t_min < rules.t_max ? kRayGoes : kRayFar;
    s.failed = 0;
    return s;
}

EDGEWISE_FN bool traceEnded(TraceState s) {
    return s.end != kRayGoes;
}
EDGEWISE_FN real traceAt(TraceState s) {
    return s.t + s.step;
}

/// The radius of the sphere that a distance allows. A lifted distance changes along the ray by its lift's slope more.
EDGEWISE_FN real sphereRadius(TraceRules rules, real t, real value) {
    real lift = rules.lift * pixelRadiusAt(rules, t);
    return (value + lift) / (real(1.0) + rules.lift * rules.pixel_slope);
}

/// Two spheres that touch the same plane and each other: r and r + m d, d apart; d = 2 r / (1 - m).
EDGEWISE_FN real planeStep(real radius, real slope) {
    return real(2.0) * radius / max(real(1.0) - slope, real(1e-6));
}

/// From a new point, whose radius changed by `slope` a unit of length since the last one.
EDGEWISE_FN real relaxedStep(TraceRules rules, TraceState s, real slope) {
    if (rules.relaxation == kRelaxKeinert) return s.radius * s.omega;
    if (rules.relaxation == kRelaxBalint)
        return s.radius + kBalintShare * (planeStep(s.radius, slope) - s.radius);
    if (rules.relaxation == kRelaxAuto) return max(s.radius, planeStep(s.radius, s.slope));
    return s.radius;
}

/// A step that may have passed a surface. Listing 2 goes on at omega (2 - omega) times the radius and relaxes no more;
/// the others at the radius, and relax again. Auto remembers what was found: free space that the next step may reach, or
/// that a surface lies before it.
EDGEWISE_FN TraceState takeBack(TraceRules rules, TraceState s, real t, real value, real radius) {
    s.failed = s.failed + 1;
    s.slope = real(-1.0);
    s.step = s.radius;
    if (rules.relaxation == kRelaxKeinert) {
        s.step = s.radius * (s.omega * (real(2.0) - s.omega));
        s.omega = real(1.0);
    }
    if (rules.relaxation == kRelaxAuto) {
        s.far_t = t;
        s.far_value = value;
        if (radius < real(0.0)) s.wall = min(s.wall, t + radius);
    }
    return s;
}

/// Goes on from a point whose sphere overlaps the last one's.
EDGEWISE_FN TraceState moveTo(TraceRules rules, TraceState s, real t, real value) {
    real radius = sphereRadius(rules, t, value);
    real slope = t > s.t ? (radius - s.radius) / (t - s.t) : real(-1.0);
    s.slope = s.slope + kAutoShare * (slope - s.slope);
    s.t = t;
    s.radius = radius;
    s.value = value;
    real pixel = pixelRadiusAt(rules, t);
    if (radius < s.candidate_error * pixel) {
        s.candidate_t = t;
        s.candidate_value = value;
        s.candidate_error = radius / pixel;
    }
    if (radius <= rules.threshold * pixel) {
        s.end = kRayHit;
    } else if (t + radius >= rules.t_max) {
        s.end = kRayFar;
    }
    // The wall holds back what is relaxed alone: fields that break their bound must not stand still before it.
    real step = min(relaxedStep(rules, s, slope), max(s.wall - t, radius));
    s.step = min(step, rules.t_max - t);
    return s;
}

/// `value`: f / L at traceAt(s), times the ray's sign.
EDGEWISE_FN TraceState traceTake(TraceRules rules, TraceState s, real value) {
    real t = traceAt(s);
    real radius = sphereRadius(rules, t, value);
    bool relaxed = s.step > s.radius;
    bool overlaps = radius >= real(0.0) && s.radius + radius >= s.step;
    if (relaxed && !overlaps) return takeBack(rules, s, t, value, radius);
    s = moveTo(rules, s, t, value);
    bool reaches = s.far_t > s.t && s.t + s.radius >= s.far_t - sphereRadius(rules, s.far_t, s.far_value);
    if (!traceEnded(s) && reaches) s = moveTo(rules, s, s.far_t, s.far_value);
    return s;
}

/// Equation 3 of Keinert et al. 2014, divided by the Lipschitz bound: where the hit moves so that its distance comes nearer
/// to the permitted error. A step leaves 1 - slope * cosine of the difference.
EDGEWISE_FN real evenedT(TraceRules rules, real t, real value) {
    return t + value - (rules.threshold - rules.lift) * pixelRadiusAt(rules, t);
}
