// GLSL to SPIR-V at run time, by glslang. Safe from several threads.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace edgewise::vulkan {

/// The first error: in which source string (`#line LINE SOURCE`; 0 without one) and line, and what.
struct GlslError : std::runtime_error {
    GlslError(int in_source, int at_line, const std::string& what)
        : std::runtime_error(what), source(in_source), line(at_line) {}
    int source, line;
};

/// A compute shader for Vulkan 1.2. Throws GlslError.
std::vector<std::uint32_t> compileGlsl(const std::string& text);

/// Macros replaced, conditions decided, comments gone; lines keep their numbers, and `#line` directives stay.
/// Throws GlslError.
std::string preprocessGlsl(const std::string& text);

}  // namespace edgewise::vulkan
