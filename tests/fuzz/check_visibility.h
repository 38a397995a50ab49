// What must hold of the visible map of any scene.
#pragma once

#include <string>

#include "analytic/screen_triangle.h"

namespace edgewise::fuzz {

/// Empty, or what is wrong in words.
std::string checkVisibility(const ScreenScene& scene);

}  // namespace edgewise::fuzz
