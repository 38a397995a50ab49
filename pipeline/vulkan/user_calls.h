// Which functions of a user's text a map needs.
#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "pipeline/vulkan/glsl_tokens.h"

namespace edgewise::vulkan {

/// A word that a map cannot have, in a function that it calls.
struct RefusedWord {
    std::size_t token;
    std::string_view why;
};

struct UserCalls {
    std::vector<std::size_t> left_out;  ///< parts: what a map neither calls nor could
    std::vector<RefusedWord> refused;
};

/// Functions go by name, so overloads stay together, but for those that no map could call. Left out are entry
/// points (main, mainImage), what only they call, what uses textures or other things that a map lacks, and
/// what calls any of these: unless `map`, `albedo` or a global's value needs it.
UserCalls userCalls(const std::vector<GlslToken>& tokens, const std::vector<GlslPart>& parts);

}  // namespace edgewise::vulkan
