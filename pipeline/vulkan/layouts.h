// shaders/shared/layouts.glsl as C++.
#pragma once

#include <cstdint>

#include "analytic/screen_triangle.h"

namespace edgewise::vulkan {

using uint = std::uint32_t;
#include "shaders/shared/layouts.glsl"

static_assert(sizeof(GpuTriangle) == sizeof(ScreenTriangle) && sizeof(GpuTriangle) == 72);
static_assert(sizeof(GpuSegment) == 88);

}  // namespace edgewise::vulkan
