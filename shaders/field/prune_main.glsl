/// A ball around all the tile's rays at depths from begin to end. The ray at t is within the origins' radius of a line
/// through the axis' origin, whose point is off the axis' by spread t, almost across it.
void ew_makeLists(EwCone cone, float begin, float end) {
    float half_width = 0.50001 * (end - begin), middle = 0.5 * (begin + end);
    vec3 center = vec3(cone.origin_x, cone.origin_y, cone.origin_z) +
                  vec3(cone.direction_x, cone.direction_y, cone.direction_z) * middle;
    float across = cone.spread * end;
    float reach = sqrt(half_width * half_width + across * across + half_width * across * cone.spread);
    // 2^-20: the roundings of a ray's position and of this one's.
    float rounding = 9.5367431640625e-07 * (length(center) + end);
    listsFor(center, (reach + cone.radius) * 1.00001 + rounding);
}

void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    uint index = i / ew_coarse, coarse = i % ew_coarse;
    EwTile tile = ew_tiles[index];
    if (!(tile.list_end > tile.list_begin)) return;
    EwCone cone = ew_cones[index];
    float width = (tile.list_end - tile.list_begin) / float(ew_segments);
    uint each = ew_segments / ew_coarse, first = coarse * each;
    for (uint b = 0u; b < ew_batches; ++b) {
        ew_place[b] = ew_coarseAt(index, coarse, b);
        ew_room[b] = ew_coarse_room[b];
        ew_forget(b);
    }
    ew_allRows();
    ew_makeLists(cone, tile.list_begin + float(first) * width, tile.list_begin + float(first + each) * width);
    bool too_long = false;
    for (uint b = 0u; b < ew_batches; ++b) {
        uint at = ew_coarseAt(index, coarse, b);
        too_long = too_long || ew_items[at] == ew_too_long;
        ew_range[b] = uvec2(at + 1u, at + 1u + ew_items[at]);
        ew_room[b] = ew_fine_room[b];
    }
    for (uint k = first; k < first + each; ++k) {
        for (uint b = 0u; b < ew_batches; ++b) {
            ew_place[b] = ew_fineAt(index, k, b);
            ew_items[ew_place[b]] = too_long ? ew_too_long : 0u;
        }
        float begin = tile.list_begin + float(k) * width;
        if (!too_long) ew_makeLists(cone, begin, begin + width);
    }
}
