// The shaders that the build compiled, by name.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace edgewise::vulkan {

/// SPIR-V of shaders/STEM.STAGE, by "STEM.STAGE". Asserts that there is one.
std::span<const std::uint32_t> spirv(std::string_view name);

}  // namespace edgewise::vulkan
