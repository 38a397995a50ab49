#define EDGEWISE_LANES 4
#define EDGEWISE_ISA avx2
#include "sdf/tape_lanes.inl"
