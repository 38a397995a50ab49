// Raw GLSL as people publish it, made ready to stand in our shaders.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sdf/field_scene.h"

namespace edgewise::vulkan {

/// Turns that all loops of one evaluation of a user's map may take together: loops without end stop there.
inline constexpr unsigned kUserTurns = 4000;

/// Limits of what a device's compiler is given: see SpirvCost.
inline constexpr unsigned kMostUserInstructions = 80000, kMostUserWords = 1024;

/// Source number of the user's text in `#line` and GlslError.
inline constexpr int kUserSource = 1;

struct UserGlsl {
    /// Declarations that the text may use (iTime, iResolution and the other inputs of Shadertoy, as
    /// constants), then the text, preprocessed, with every loop's condition counted by
    ///     bool ew_turn(uint line)    false: the budget is spent
    /// Entry points (main, mainImage), what only they call, and functions with textures that the map does not
    /// call are left out; uniforms and varyings of other names are 0. Lines are the file's, whatever #line
    /// says.
    std::string text;
    bool has_albedo = false;
    bool has_loops = false;
};

/// Throws InputError "FILE: line N: ..." for what does not preprocess or is beyond the limits of
/// macro_growth.h, for textures and the like in what the map calls, and for a text without `float map(vec3
/// p)`.
UserGlsl prepareUserGlsl(const sdf::GlslMap& map, int width, int height);

/// compileGlsl of a shader that holds the user's text: an error there is an InputError with its line. Throws
/// FailureError beyond the limits above.
std::vector<std::uint32_t> compileWithUserGlsl(const std::string& shader, const std::string& file);

}  // namespace edgewise::vulkan
