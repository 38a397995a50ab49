void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    ew_list_of = i / ew_segments;
    ew_segment_of = i % ew_segments;
    EwCone cone = ew_cones[ew_list_of];
    EwTile tile = ew_tiles[ew_list_of];
    for (uint b = 0u; b < ew_batches; ++b) ew_forget(b);
    if (!(tile.list_end > tile.list_begin)) return;
    float width = (tile.list_end - tile.list_begin) / float(ew_segments);
    float middle = tile.list_begin + (float(ew_segment_of) + 0.5) * width, end = middle + 0.5 * width;
    vec3 origin = vec3(cone.origin_x, cone.origin_y, cone.origin_z);
    vec3 center = origin + vec3(cone.direction_x, cone.direction_y, cone.direction_z) * middle;
    float size = max(length(center), end);
    // The rays, and what the slope is taken from beside them.
    float pixel = cone.pixel_radius + cone.pixel_slope * end;
    float radius = 0.50001 * width + cone.radius + cone.spread * end + pixel + 6.0e-4 * size;
    EW_ALL_ROWS;
    listsFor(center, radius);
}
