// GLSL only: what gather's shaders read.
#include "shared/real_bits.glsl"
#include "shared/layouts.glsl"
#include "shared/cell_overlap.glsl"

layout(std430, binding = kGatherTriangles) readonly buffer Triangles { GpuTriangle triangles[]; };
layout(std430, binding = kGatherHistogram) buffer Histogram { uint histogram[]; };
layout(push_constant) uniform Push { GatherGrid grid; };

/// Cell i of the 2 x 2 from `first` on, in rows.
uint directCell(uint first, int i) { return first + uint(i & 1) + uint((i >> 1) * grid.columns); }
