#version 460
#include "shared/weight_terms.glsl"
