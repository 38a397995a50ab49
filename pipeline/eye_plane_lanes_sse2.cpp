#define EDGEWISE_LANES 2
#define EDGEWISE_ISA sse2
#include "pipeline/eye_plane_lanes.inl"
