#version 460
#define EDGEWISE_FP32
#include "shared/weight_terms.glsl"
