#define EDGEWISE_ISA avx512
#define EDGEWISE_LANES 8
#include "analytic/edge_lanes.inl"
