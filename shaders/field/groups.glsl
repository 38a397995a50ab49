// Hit groups along rays' cones by sdf_cone_step.glsl. A ray pauses when it has as many as there is room for; the host takes
// them, and it goes on.
struct EwConeState {
    float t, safe_t, last_t, value, slope, wall, entry_t, hard_t, least;
    uint how;  // the end in 2 bits, then a bit each; from bit 8 on: groups
    uint evaluations;
};
struct EwGroup {
    uint t_hard;  // t's bits, and the sign's: whether it is hard
    float entry_t, least;
};
const uint ew_open_bit = 4u, ew_hard_bit = 8u, ew_negative_bit = 16u, ew_longer_bit = 32u, ew_missed_bit = 64u;
layout(std430, binding = 1) buffer EwConeStates { EwConeState ew_cone_states[]; };
layout(std430, binding = 2) writeonly buffer EwGroups { EwGroup ew_groups[]; };  // the first of each ray, then the second

ew_ConeRules ew_coneRulesOf(EwRay ray) {
    ew_ConeRules rules;
    rules.t_max = ray.t_max;
    rules.radius = ew_cone_scale * ray.pixel_radius;
    rules.slope = ew_cone_scale * ray.pixel_slope;
    rules.alpha = ew_cone_alpha;
    rules.hard = ew_cone_hard;
    rules.relaxed = ew_cone_relaxed;
    rules.backtrace = ew_cone_backtrace;
    rules.overstep = ew_cone_overstep;
    return rules;
}
ew_ConeState ew_unpacked(EwConeState kept) {
    ew_ConeState s;
    s.t = kept.t;
    s.safe_t = kept.safe_t;
    s.last_t = kept.last_t;
    s.value = kept.value;
    s.slope = kept.slope;
    s.wall = kept.wall;
    s.entry_t = kept.entry_t;
    s.hard_t = kept.hard_t;
    s.least = kept.least;
    s.longer = (kept.how & ew_longer_bit) != 0u;
    s.missed = (kept.how & ew_missed_bit) != 0u;
    s.open = (kept.how & ew_open_bit) != 0u;
    s.hard = (kept.how & ew_hard_bit) != 0u;
    s.closed = false;
    s.end = int(kept.how & 3u);
    return s;
}
EwConeState ew_packed(ew_ConeState s, bool negative, uint groups, uint evaluations) {
    uint how = uint(s.end) | (s.open ? ew_open_bit : 0u) | (s.hard ? ew_hard_bit : 0u) |
               (negative ? ew_negative_bit : 0u) | (s.longer ? ew_longer_bit : 0u) |
               (s.missed ? ew_missed_bit : 0u);
    return EwConeState(s.t, s.safe_t, s.last_t, s.value, s.slope, s.wall, s.entry_t, s.hard_t, s.least, how | groups << 8,
                       evaluations);
}

/// A ray's groups until its invocation ends.
EwGroup ew_closed[ew_room];
void ew_close(uint place, ew_ConeState s) {
    EwGroup made =
        EwGroup(floatBitsToUint(ew_coneSampleAt(s)) | (s.hard ? 0x80000000u : 0u), s.entry_t, ew_coneLeast(s));
    for (uint k = 0u; k < ew_room; ++k)
        if (k == place) ew_closed[k] = made;
}

void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    EwRay ray = ew_rays[i];
    ew_ConeRules rules = ew_coneRulesOf(ray);
    uint tile = i / 64u, groups = 0u, evaluations = 0u;
    bool negative = ray.sign < 0.0;
    ew_ConeState s;
    if (ew_fresh == 1u) {
        s = ew_coneFrom(rules, ew_pruned != 0u || ew_prepass ? max(ray.t_min, ew_tiles[tile].begin) : ray.t_min);
    } else {
        EwConeState kept = ew_cone_states[i];
        s = ew_unpacked(kept);
        negative = (kept.how & ew_negative_bit) != 0u;
        evaluations = kept.evaluations;
        groups = kept.how >> 8;
        if (ew_fresh == 2u && groups == ew_room && !ew_coneEnded(s)) groups = 0u;  // they are taken
    }
    uint taken = groups;
    for (uint k = 0u; k < ew_steps && !ew_coneEnded(s) && groups < ew_room && ew_turns <= ew_most_turns && !ew_failed(); ++k) {
        float t = ew_coneAt(s);
        EW_ROWS_AT(tile, t);
        ++ew_turns;
        float value = ew_fieldAt(ew_origin(ray) + ew_direction(ray) * t);
        if (ray.sign == 0.0 && evaluations == 0u) negative = value < 0.0;
        s = ew_coneTake(rules, s, negative ? -value : value);
        if (++evaluations >= ew_most_iterations) s = ew_coneStopped(s);
        if (s.closed) ew_close(groups++, s);
    }
    for (uint k = 0u; k < ew_room; ++k)
        if (k >= taken && k < groups) ew_groups[k * ew_count + i] = ew_closed[k];
    ew_cone_states[i] = ew_packed(s, negative, groups, evaluations);
    ew_report();
    if (ew_coneEnded(s) || ew_failed()) return;
    atomicAdd(ew_flags[groups < ew_room ? 5 : 6], 1u);
}
