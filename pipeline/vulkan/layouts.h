// shaders/shared/layouts.glsl as C++.
#pragma once

#include <cstddef>
#include <cstdint>

#include "analytic/screen_triangle.h"

namespace edgewise::vulkan {

using uint = std::uint32_t;
#include "shaders/shared/layouts.glsl"

static_assert(sizeof(GpuTriangle) == 72 && sizeof(GpuTriangle) == sizeof(ScreenTriangle));
static_assert(offsetof(GpuTriangle, vertex) == offsetof(ScreenTriangle, vertex));
static_assert(offsetof(GpuTriangle, owner) == offsetof(ScreenTriangle, owner));
static_assert(offsetof(GpuTriangle, plane) == offsetof(ScreenTriangle, plane));
static_assert(sizeof(GpuSegment) == 88);

}  // namespace edgewise::vulkan
