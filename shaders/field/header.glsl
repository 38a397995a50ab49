// What every shader of a field begins with. Names of ours start with ew_: a user's map may stand behind this text.
// Rays of 8 x 8 neighbours are neighbours in ew_rays: a workgroup is a tile.
layout(local_size_x = 64) in;

struct EwRay {
    float origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
    float t_min, t_max;                // t_max < t_min: nothing to trace
    float pixel_radius, pixel_slope;   // half a pixel's side along the ray
    float sign;                        // of the field that is traced; 0: of the value where the ray begins
};
struct EwCone {
    float origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
    float radius, spread;              // rays of the tile are within radius + spread t of the axis at t
    float t_min, t_max;                // the least, the largest of the rays
    float reach, reach_slope;          // what is nearer to a ray than reach + reach_slope t counts
    float sign;                                     // of all rays; 0: they differ
};
struct EwTile { float begin, list_begin, list_end; uint evaluations; };

layout(std430, binding = 0) readonly buffer EwRays { EwRay ew_rays[]; };
layout(std430, binding = 3) readonly buffer EwCones { EwCone ew_cones[]; };
layout(std430, binding = 4) buffer EwTiles { EwTile ew_tiles[]; };
EW_TABLE_BLOCK EwTable { uvec4 ew_table[EW_TABLE_LENGTH]; };
layout(std430, binding = 6) buffer EwItems { uint ew_items[]; };
/// 0: a value that is no number: 1; its position in 1 to 3; 4: a user's loop without end: its line; 5: active rays; 6: rays
/// without room for more.
layout(std430, binding = 7) buffer EwFlags { uint ew_flags[]; };
layout(push_constant) uniform EwPush {
    uint ew_count;        // rays, tiles or tiles times segments
    uint ew_first;        // of a pass in parts
    uint ew_steps;        // of this dispatch
    uint ew_fresh;        // 1: states begin
    uint ew_pruned;       // 1: lists are there
};

uint ew_turns = 0u, ew_user_turns = 0u, ew_stuck_line = 0u;
bool ew_turn(uint line) {
    ++ew_turns;
    ++ew_user_turns;
    if (ew_user_turns <= ew_most_user_turns) return true;
    ew_stuck_line = line;
    return false;
}
