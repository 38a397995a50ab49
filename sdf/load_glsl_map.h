// A .map.glsl text as a scene: its header comments; the GLSL itself is the compiler's to judge.
#pragma once

#include <string>
#include <string_view>

#include "sdf/field_scene.h"

namespace edgewise::sdf {

/// Bytes of such a text; more is refused.
inline constexpr std::size_t kMostMapBytes = std::size_t(1) << 20;

/// The header is the comments, blank lines, directives and `precision` statements at the top. Of its `//`
/// lines these are read, each any number of times where it says so:
///     // camera: eye X Y Z target X Y Z fovy DEGREES    (fovy may be left out)     any number
///     // light: direction X Y Z                         the way the light travels  any number
///     // background: R G B        // far: T        // lipschitz: L                 once
/// A light is of pi lux, white on the surface that faces it; with lights there is an ambient term of 0.15.
/// Others are free text. Throws SceneError "line N" and the rule for a malformed one, for a text without a
/// function `float map(`, or with a NUL byte. A byte order mark is dropped, and a lone CR ends a line.
FieldScene loadGlslMap(std::string_view text, const std::string& file);

}  // namespace edgewise::sdf
