#define EDGEWISE_LANES 1
#define EDGEWISE_ISA scalar
#include "pipeline/eye_plane_lanes.inl"
