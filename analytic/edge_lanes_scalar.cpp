#define EDGEWISE_ISA scalar
#define EDGEWISE_LANES 1
#include "analytic/edge_lanes.inl"
