#define EDGEWISE_LANES 8
#define EDGEWISE_ISA avx512
#include "sdf/tape_lanes.inl"
