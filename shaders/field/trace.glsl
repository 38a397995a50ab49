// Steps of rays: as many as a dispatch may take, then the state is kept for the next one.

/// A relaxed step that may have passed something is taken back: Keinert's to where an unrelaxed one would lead, once and
/// for all; the others' likewise, and they relax again by themselves.
void ew_takeBack(inout EwState s, float value) {
    ++s.failed;
    if (ew_relaxation == 1u) {
        s.step -= s.omega * s.step;
        s.omega = 1.0;
        s.t += s.step;
        s.before = abs(value);
    } else {
        s.t = s.t - s.step + s.before;
        s.step = s.before;
        s.slope = -1.0;
    }
}

/// Keinert et al. 2014; Balint and Valasek 2018: a plane of the slope just seen allows 2 / (1 - slope); Ban and Valasek
/// 2023: of the slopes seen, smoothed.
float ew_nextOmega(inout EwState s, float value) {
    if (ew_relaxation < 2u) return s.omega;
    float seen = s.step > 0.0 ? (value - s.before) / s.step : -1.0;
    s.slope = ew_relaxation == 2u ? seen : mix(s.slope, seen, 0.3);
    s.slope = clamp(s.slope, -1.0, 0.999);
    return max(1.0, 2.0 / (1.0 - s.slope));
}

void ew_stepOnce(EwRay ray, inout EwState s, float value) {
    float pixel = ew_pixel(ray, s.t), threshold = ew_threshold * pixel;
    float field = ew_level_set ? value + threshold : value;
    bool relaxed = ew_relaxation == 1u ? s.omega > 1.0 : ew_relaxation > 1u;
    if (relaxed && abs(field) + abs(s.before) < s.step) {
        ew_takeBack(s, field);
        return;
    }
    float error = abs(field) / pixel;
    if (error < s.candidate_error) {
        s.candidate_error = error;
        s.candidate_t = s.t;
    }
    if (field < threshold) {
        s.end = ew_surface;
        return;
    }
    if (s.t >= ray.t_max) {
        s.end = ew_far;
        return;
    }
    float step = field * ew_nextOmega(s, field);
    s.before = field;
    s.step = min(step, ray.t_max - s.t);
    if (s.t + field > ray.t_max) s.end = ew_far;
    s.t += s.step;
}

/// Out of steps.
void ew_finish(inout EwState s) {
    s.t = ew_screen_candidate ? s.candidate_t : s.last_t;
    s.end = !ew_screen_candidate || s.candidate_error <= 1.0 ? ew_candidate : ew_out_of_steps;
}

EwState ew_begin(EwRay ray, uint tile) {
    EwState s;
    s.t = ray.t_min;
    if (ew_pruned != 0u || ew_prepass) s.t = max(s.t, ew_tiles[tile].begin);
    s.before = s.step = 0.0;
    s.omega = ew_omega;
    s.slope = -1.0;
    s.sign = ray.sign;
    s.candidate_t = s.t;
    s.candidate_error = 3.0e38;
    s.last_t = s.t;
    s.evaluations = s.iterations = s.failed = 0u;
    s.end = s.t > ray.t_max || ray.t_max < ray.t_min ? ew_empty : ew_running;
    return s;
}

void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    EwRay ray = ew_rays[i];
    uint tile = i / 64u;
    EwState s = ew_states[i];
    if (ew_fresh != 0u) s = ew_begin(ray, tile);
    for (uint k = 0u; k < ew_steps && s.end == ew_running && ew_turns <= ew_most_turns && !ew_failed(); ++k) {
        EW_ROWS_AT(tile, s.t);
        ++ew_turns;
        float value = ew_fieldAt(ew_origin(ray) + ew_direction(ray) * s.t);
        s.last_t = s.t;
        ++s.evaluations;
        ++s.iterations;
        if (s.sign == 0.0) s.sign = value < 0.0 ? -1.0 : 1.0;
        ew_stepOnce(ray, s, s.sign * value);
        if (s.end == ew_running && s.iterations >= ew_most_iterations) ew_finish(s);
    }
    ew_states[i] = s;
    if (s.end == ew_running && !ew_failed()) atomicAdd(ew_flags[5], 1u);
}
