#define EDGEWISE_LANES 2
#define EDGEWISE_ISA sse2
#include "sdf/tape_lanes.inl"
