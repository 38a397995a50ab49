// Of rays that are traced to their hit.
struct EwState {
    ew_TraceState at;
    float sign;
    uint evaluations, iterations, end;
};
struct EwHit {
    float t, value, normal_x, normal_y, normal_z, color_r, color_g, color_b;  // value: over L, times the sign
};

const uint ew_running = 0u, ew_surface = 1u, ew_candidate = 2u, ew_far = 3u, ew_out_of_steps = 4u, ew_empty = 5u;

layout(std430, binding = 1) buffer EwStates { EwState ew_states[]; };
layout(std430, binding = 2) buffer EwHits { EwHit ew_hits[]; };

ew_TraceRules ew_rulesOf(EwRay ray) {
    ew_TraceRules rules;
    rules.relaxation = ew_relaxation;
    rules.omega = ew_omega;
    rules.t_max = ray.t_max;
    rules.pixel_radius = ray.pixel_radius;
    rules.pixel_slope = ray.pixel_slope;
    rules.threshold = ew_threshold;
    rules.lift = ew_level_set ? ew_threshold : 0.0;
    return rules;
}
