// The field with what goes with asking it.
bool ew_isNumber(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

/// Over its Lipschitz bound. A value that is no number is noted, and ends the run.
float ew_fieldAt(vec3 p) {
    ew_user_turns = 0u;
    float value = fieldAt(p);
    if (ew_stuck_line != 0u) ew_flags[4] = ew_stuck_line;
    if (!ew_isNumber(value)) {
        ew_flags[1] = floatBitsToUint(p.x);
        ew_flags[2] = floatBitsToUint(p.y);
        ew_flags[3] = floatBitsToUint(p.z);
        ew_flags[0] = 1u;
        return 0.0;
    }
    return value * ew_inverse_lipschitz;
}
bool ew_failed() { return ew_stuck_line != 0u || ew_flags[0] != 0u; }

vec3 ew_origin(EwRay ray) { return vec3(ray.origin_x, ray.origin_y, ray.origin_z); }
vec3 ew_direction(EwRay ray) { return vec3(ray.direction_x, ray.direction_y, ray.direction_z); }
