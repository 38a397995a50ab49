// How long a text becomes when its macros are replaced, without replacing them.
#pragma once

#include <cstddef>
#include <string>

namespace edgewise::vulkan {

/// Words and signs of a preprocessed text, at most; brackets within brackets; macros within macros.
inline constexpr std::size_t kMostGlslWords = 250000;
inline constexpr int kMostGlslBrackets = 250, kMostMacroNesting = 250;

/// Of GLSL without comments. An upper bound: of macros that are defined more than once the longest counts,
/// both sides of a condition do, and a parameter that is called may be any macro. Throws GlslError with the
/// line that leads beyond one of the limits.
void requireShortExpansion(const std::string& text);

}  // namespace edgewise::vulkan
