#define EDGEWISE_ISA sse2
#define EDGEWISE_LANES 2
#include "analytic/edge_lanes.inl"
