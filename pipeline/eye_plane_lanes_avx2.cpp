#define EDGEWISE_LANES 4
#define EDGEWISE_ISA avx2
#include "pipeline/eye_plane_lanes.inl"
