#define EDGEWISE_LANES 2

#define EDGEWISE_ISA sse2
#include "analytic/edge_lanes.inl"

#undef EDGEWISE_ISA
#define EDGEWISE_ISA sse2_fp32
#define EDGEWISE_FP32
#include "analytic/edge_lanes.inl"
