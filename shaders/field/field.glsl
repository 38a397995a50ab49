// The field with what goes with asking it.
bool ew_isNumber(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

bool ew_no_number = false;
vec3 ew_no_number_at = vec3(0.0);

/// Over its Lipschitz bound. A value that is no number is noted, and ends the invocation. What is noted stays in the
/// invocation until ew_report(): lavapipe reaches into buffers, even where no invocation does, more slowly than it steps.
float ew_fieldAt(vec3 p) {
    ew_user_turns = 0u;
    float value = fieldAt(p);
    if (!ew_isNumber(value)) {
        ew_no_number = true;
        ew_no_number_at = p;
        return 0.0;
    }
    return value * ew_inverse_lipschitz;
}
bool ew_failed() { return ew_stuck_line != 0u || ew_no_number; }
/// At an invocation's end.
void ew_report() {
    if (ew_stuck_line != 0u) ew_flags[4] = ew_stuck_line;
    if (!ew_no_number) return;
    ew_flags[1] = floatBitsToUint(ew_no_number_at.x);
    ew_flags[2] = floatBitsToUint(ew_no_number_at.y);
    ew_flags[3] = floatBitsToUint(ew_no_number_at.z);
    ew_flags[0] = 1u;
}

vec3 ew_origin(EwRay ray) { return vec3(ray.origin_x, ray.origin_y, ray.origin_z); }
vec3 ew_direction(EwRay ray) { return vec3(ray.direction_x, ray.direction_y, ray.direction_z); }
