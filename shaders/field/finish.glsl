// After the hit, one evaluation a turn: steps of equation 3 (Keinert et al. 2014); then, of a map, the field's slope by a
// tetrahedron of half a pixel's radius, but no less than what float resolves of the position, and its colour.

vec3 ew_corner(uint k) {
    return vec3(k == 0u || k == 3u ? 1.0 : -1.0, k == 1u || k == 3u ? 1.0 : -1.0, k == 2u || k == 3u ? 1.0 : -1.0);
}

EwHit ew_hitOf(EwState s) {
    EwHit hit;
    bool candidate = s.end == ew_candidate && ew_screen_candidate;
    hit.t = candidate ? s.at.candidate_t : s.at.t;
    hit.value = candidate ? s.at.candidate_value : s.at.value;
    hit.normal_x = hit.normal_y = hit.normal_z = 0.0;
    hit.color_r = hit.color_g = hit.color_b = 0.0;
    return hit;
}

void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    EwState s = ew_states[i];
    if (s.end != ew_surface && s.end != ew_candidate) return;
    EwRay ray = ew_rays[i];
    ew_TraceRules rules = ew_rulesOf(ray);
    uint tile = i / 64u;
    EwHit hit;
    if (ew_fresh != 0u)
        hit = ew_hitOf(s);
    else
        hit = ew_hits[i];
    vec3 normal = vec3(hit.normal_x, hit.normal_y, hit.normal_z);
    // ew_steps: the first and the last turn of this dispatch.
    uint first = ew_steps & 0xffffu, last = ew_steps >> 16u;
    for (uint k = first; k < last; ++k) {
        bool at_corner = k >= ew_discontinuity;
        if (!at_corner && s.end == ew_candidate) continue;
        if (!at_corner) hit.t = ew_evenedT(rules, hit.t, hit.value);
        vec3 p = ew_origin(ray) + ew_direction(ray) * hit.t;
        EW_ROWS_AT(tile, hit.t);
        float size = max(max(abs(p.x), abs(p.y)), max(abs(p.z), abs(hit.t)));
        float reach = max(0.5 * ew_pixelRadiusAt(rules, hit.t), 4.8828125e-4 * size);
        vec3 corner = at_corner ? ew_corner(k - ew_discontinuity) : vec3(0.0);
        float value = s.sign * ew_fieldAt(p + corner * (reach * 0.57735027));
        if (at_corner) {
            normal += corner * value;
        } else {
            ++s.evaluations;
            hit.value = value;
        }
    }
    if (ew_corners != 0u && last == ew_discontinuity + ew_corners) {
        vec3 p = ew_origin(ray) + ew_direction(ray) * hit.t;
        float size = length(normal);
        normal = size > 0.0 ? normal / size : -ew_direction(ray);
        vec3 color = EW_ALBEDO(p, normal);
        hit.color_r = color.x;
        hit.color_g = color.y;
        hit.color_b = color.z;
    }
    hit.normal_x = normal.x;
    hit.normal_y = normal.y;
    hit.normal_z = normal.z;
    ew_hits[i] = hit;
    if (first < ew_discontinuity) ew_states[i].evaluations = s.evaluations;
    ew_report();
}
