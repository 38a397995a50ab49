#define EDGEWISE_LANES 1
#define EDGEWISE_ISA scalar
#include "sdf/tape_lanes.inl"
