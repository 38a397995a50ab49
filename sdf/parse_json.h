// JSON text to a document, strictly: nothing twice, nothing nested without end.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace edgewise::sdf {

using Json = nlohmann::json;

/// Arrays and objects within each other: two a node of a tree, and some.
inline constexpr int kMostJsonLevels = 600;

/// Throws SceneError naming line and column for text that is no JSON (duplicate keys, numbers beyond double
/// and depths beyond kMostJsonLevels included).
Json parseJson(std::string_view text);

}  // namespace edgewise::sdf
