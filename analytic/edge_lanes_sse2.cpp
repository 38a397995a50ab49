#define EDGEWISE_ISA sse2
#define EDGEWISE_LANES 8
#include "analytic/edge_lanes.inl"
