#define EDGEWISE_ISA avx2
#define EDGEWISE_LANES 4
#include "analytic/edge_lanes.inl"
