#define EDGEWISE_LANES 4

#define EDGEWISE_ISA avx2
#include "analytic/edge_lanes.inl"

#undef EDGEWISE_ISA
#define EDGEWISE_ISA avx2_fp32
#define EDGEWISE_FP32
#include "analytic/edge_lanes.inl"
