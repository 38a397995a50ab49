#version 460
// One vertex a wide triangle, for the geometry shader.
#include "shared/layouts.glsl"
layout(std430, binding = kGatherWide) readonly buffer Wide { uint wide[]; };
layout(location = 0) flat out uint triangle;

void main() {
    triangle = wide[gl_VertexIndex];
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
