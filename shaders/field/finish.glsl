// After the hit, one evaluation a turn: steps of equation 3 (Keinert et al. 2014), the field's value, and its slope by a
// tetrahedron of half a pixel's radius, but no less than what float resolves of the position.

vec3 ew_corner(uint k) {
    return vec3(k == 0u || k == 3u ? 1.0 : -1.0, k == 1u || k == 3u ? 1.0 : -1.0, k == 2u || k == 3u ? 1.0 : -1.0);
}

void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    EwState s = ew_states[i];
    EwHit hit;
    if (s.end != ew_surface && s.end != ew_candidate) return;
    EwRay ray = ew_rays[i];
    uint tile = i / 64u;
    hit = ew_hits[i];
    vec3 normal = vec3(hit.normal_x, hit.normal_y, hit.normal_z);
    if (ew_fresh != 0u) {
        hit.t = s.t;
        normal = vec3(0.0);
    }
    // ew_steps: the first and the last turn of this dispatch.
    for (uint k = ew_steps & 0xffffu; k < ew_steps >> 16u; ++k) {
        vec3 p = ew_origin(ray) + ew_direction(ray) * hit.t;
        EW_ROWS_AT(tile, hit.t);
        float size = max(max(abs(p.x), abs(p.y)), max(abs(p.z), abs(hit.t)));
        float reach = max(0.5 * ew_pixel(ray, hit.t), 4.8828125e-4 * size);
        bool at_corner = k > ew_discontinuity;
        vec3 corner = at_corner ? ew_corner(k - ew_discontinuity - 1u) : vec3(0.0);
        float value = s.sign * ew_fieldAt(p + corner * (reach * 0.57735027));
        ++s.evaluations;
        if (at_corner) {
            normal += corner * value;
        } else {
            hit.value = value;
            float level = ew_level_set ? 0.0 : ew_threshold * ew_pixel(ray, hit.t);
            if (k < ew_discontinuity) hit.t += value - level;
        }
    }
    if (ew_steps >> 16u == ew_discontinuity + 5u) {
        vec3 p = ew_origin(ray) + ew_direction(ray) * hit.t, local = p;
        EW_ROWS_AT(tile, hit.t);
        float size = length(normal);
        normal = size > 0.0 ? normal / size : -ew_direction(ray);
        hit.material = EW_WINNER_AT(p, local);
        vec3 color = EW_ALBEDO(p, normal);
        hit.local_x = local.x;
        hit.local_y = local.y;
        hit.local_z = local.z;
        hit.color_r = color.x;
        hit.color_g = color.y;
        hit.color_b = color.z;
    }
    hit.normal_x = normal.x;
    hit.normal_y = normal.y;
    hit.normal_z = normal.z;
    ew_hits[i] = hit;
    ew_states[i] = s;
}
