#define EDGEWISE_LANES 8
#define EDGEWISE_ISA avx512
#include "pipeline/eye_plane_lanes.inl"
