// A map and its colour at points: a ray's origin is the point, its direction the surface's normal.

struct EwPoint { float value, color_r, color_g, color_b; };
layout(std430, binding = 2) writeonly buffer EwPoints { EwPoint ew_points[]; };

void main() {
    uint i = gl_GlobalInvocationID.x + ew_first;
    if (i >= ew_count) return;
    EwRay ray = ew_rays[i];
    EW_ROWS_AT(i / 64u, 0.0);
    EwPoint made;
    made.value = ew_fieldAt(ew_origin(ray));
    vec3 color = vec3(0.0);
    if (ew_fresh != 0u) color = EW_ALBEDO(ew_origin(ray), ew_direction(ray));
    made.color_r = color.x;
    made.color_g = color.y;
    made.color_b = color.z;
    ew_points[i] = made;
    ew_report();
}
