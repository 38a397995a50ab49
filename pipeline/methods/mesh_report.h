// A mesh's record as JSON: what --stats and results.json print, and workers send.
#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/methods/method.h"

namespace edgewise {

/// null: there was none.
nlohmann::ordered_json meshJson(const std::optional<MeshReport>& mesh);
std::optional<MeshReport> meshFromJson(const nlohmann::json& json);

}  // namespace edgewise
