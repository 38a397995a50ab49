#define EDGEWISE_LANES 8

#define EDGEWISE_ISA avx512
#include "analytic/edge_lanes.inl"

#undef EDGEWISE_ISA
#define EDGEWISE_ISA avx512_fp32
#define EDGEWISE_FP32
#include "analytic/edge_lanes.inl"
