// Arithmetic that no driver may rearrange: `precise`, for every floating-point operation of a shader.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace edgewise::vulkan {

/// The module with NoContraction on each of its sums, products, quotients and negations: the driver neither
/// fuses nor reassociates them, as -ffp-contract=off has it in C++.
std::vector<std::uint32_t> withExactArithmetic(std::span<const std::uint32_t> module);

}  // namespace edgewise::vulkan
