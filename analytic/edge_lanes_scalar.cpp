#define EDGEWISE_LANES 1

#define EDGEWISE_ISA scalar
#include "analytic/edge_lanes.inl"

#undef EDGEWISE_ISA
#define EDGEWISE_ISA scalar_fp32
#define EDGEWISE_FP32
#include "analytic/edge_lanes.inl"
