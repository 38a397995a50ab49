// What a compiled shader costs the device's compiler, which puts every function in the place of its calls.
#pragma once

#include <cstdint>
#include <span>

namespace edgewise::vulkan {

struct SpirvCost {
    /// Over all functions: instructions, with those of the functions that they call, call by call.
    double instructions = 0.0;
    /// Of variables that are not in buffers, with those of called functions, call by call, in 32-bit words.
    double variable_words = 0.0;
};

/// Of a valid module; functions do not call themselves.
SpirvCost spirvCost(std::span<const std::uint32_t> words);

}  // namespace edgewise::vulkan
