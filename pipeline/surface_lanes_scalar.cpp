#define EDGEWISE_LANES 1
#define EDGEWISE_ISA scalar
#include "pipeline/surface_lanes.inl"
