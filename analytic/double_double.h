// shaders/shared/double_double.glsl as C++ double, with the elementary functions.
#pragma once

#include "analytic/transcendental.h"
