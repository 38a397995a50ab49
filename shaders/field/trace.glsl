// Steps of rays by sdf_trace_step.glsl: as many as a dispatch may take, then the state is kept for the next one.

EwState ew_begin(EwRay ray, uint tile) {
    EwState s;
    float start = ray.t_min;
    if (ew_pruned != 0u || ew_prepass) start = max(start, ew_tiles[tile].begin);
    s.at = ew_traceFrom(ew_rulesOf(ray), start);
    s.sign = ray.sign;
    s.evaluations = s.iterations = 0u;
    s.end = ew_traceEnded(s.at) ? ew_empty : ew_running;
    return s;
}

/// Of a ray that is out of steps the last point stands for the surface, however far it is from one, or the nearest on the
/// screen where half a pixel holds it.
uint ew_endOf(EwState s) {
    if (s.at.end == ew_kRayHit) return ew_surface;
    if (s.at.end == ew_kRayFar) return ew_far;
    if (s.iterations < ew_most_iterations) return ew_running;
    return !ew_screen_candidate || s.at.candidate_error <= 1.0 ? ew_candidate : ew_out_of_steps;
}

/// Of a ray that has ended, what is asked of it.
void ew_keepEnd(uint i, EwState s) {
    ew_states[i].at.t = s.at.t;
    ew_states[i].at.value = s.at.value;
    ew_states[i].at.candidate_t = s.at.candidate_t;
    ew_states[i].at.candidate_value = s.at.candidate_value;
    ew_states[i].at.failed = s.at.failed;
    ew_states[i].sign = s.sign;
    ew_states[i].evaluations = s.evaluations;
    ew_states[i].iterations = s.iterations;
    ew_states[i].end = s.end;
}

void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    EwRay ray = ew_rays[i];
    ew_TraceRules rules = ew_rulesOf(ray);
    uint tile = i / 64u;
    EwState s;
    if (ew_fresh != 0u)
        s = ew_begin(ray, tile);
    else
        s = ew_states[i];
    for (uint k = 0u; k < ew_steps && s.end == ew_running && ew_turns <= ew_most_turns && !ew_failed(); ++k) {
        float t = ew_traceAt(s.at);
        EW_ROWS_AT(tile, t);
        ++ew_turns;
        float value = ew_fieldAt(ew_origin(ray) + ew_direction(ray) * t);
        ++s.evaluations;
        ++s.iterations;
        if (s.sign == 0.0) s.sign = value < 0.0 ? -1.0 : 1.0;
        s.at = ew_traceTake(rules, s.at, s.sign * value);
        s.end = ew_endOf(s);
    }
    if (s.end == ew_running) {
        ew_states[i] = s;
        if (!ew_failed()) atomicAdd(ew_flags[5], 1u);
    } else {
        ew_keepEnd(i, s);
    }
    ew_report();
}
