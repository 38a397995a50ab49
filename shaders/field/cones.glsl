// How far every ray of a tile may start: a cone around them steps through the empty part. The ray at u is within
// radius + spread u of the axis at u, so within that + (u - t) of the axis at t.
// Where rays differ in sign, no cone goes anywhere.

void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    EwCone cone = ew_cones[i];
    EwTile tile = ew_tiles[i];
    vec3 origin = vec3(cone.origin_x, cone.origin_y, cone.origin_z);
    vec3 direction = vec3(cone.direction_x, cone.direction_y, cone.direction_z);
    float t = tile.begin;
    bool open = ew_fresh != 0u || tile.list_end != 0.0;
    EW_ALL_ROWS;
    for (uint k = 0u; k < ew_steps && open && t <= cone.t_max && ew_turns <= ew_most_turns && !ew_failed(); ++k) {
        ++ew_turns;
        float value = cone.sign * ew_fieldAt(origin + direction * t);
        ++tile.evaluations;
        float radius = cone.radius + cone.spread * t;
        float reach = cone.reach + cone.reach_slope * t;
        // 2^-16 of the position: what float is off.
        float slack = 1.52587890625e-05 * (length(origin) + t);
        float step = (value - radius - reach - slack) / (1.0 + cone.spread + cone.reach_slope);
        open = step > 0.25 * radius && step > slack;
        if (step > 0.0) t += step;
    }
    open = open && t <= cone.t_max;
    if (open) atomicAdd(ew_flags[5], 1u);
    tile.begin = t;
    tile.list_end = open ? 1.0 : 0.0;
    ew_tiles[i] = tile;
    ew_report();
}
