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
static_assert(sizeof(OwnerRecord) == 32 && sizeof(SurfaceRecord) == 32 && sizeof(LevelRecord) == 16);
static_assert(sizeof(MaterialRecord) == 112 && sizeof(MapRecord) == 88 && sizeof(LightRecord) == 104);
static_assert(sizeof(ShadeFrame) == 20 * 8 + 16 && sizeof(ShadePush) == 24);
static_assert(sizeof(RasterPush) == 88 && sizeof(DepthPlane) == 24 && sizeof(ResolveStatus) == 12);

}  // namespace edgewise::vulkan
