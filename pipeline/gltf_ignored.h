// What a glTF uses and edgewise does not draw: warnings, each once, with a count.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "pipeline/scene.h"

namespace edgewise {

/// Features of the whole file that are left out, in a fixed order; extensions last, by name.
std::vector<Ignored> listIgnored(const nlohmann::json& root);

/// Adds `count` to the scene's entry `what`.
void countIgnored(Scene& scene, std::string_view what, std::size_t count = 1);

}  // namespace edgewise
