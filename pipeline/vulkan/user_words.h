// Words of GLSL that a user's map has or lacks.
#pragma once

#include <string_view>

namespace edgewise::vulkan {

/// A word of desktop GLSL's own, or one that it keeps for later: in GLSL ES, or in one of its versions, a
/// free name.
bool isFreeNameInEs(std::string_view word);

/// A function that desktop GLSL has and GLSL ES 1.00 lacks: people define their own.
bool isFunctionEsLacks(std::string_view word);

/// Why a map cannot have it (textures, what belongs to fragments, what other invocations see); empty for
/// other words.
std::string_view whyNotInMaps(std::string_view word, bool called);

/// A scalar, a vector or a matrix of numbers or truths.
bool isPlainType(std::string_view word);

/// A sampler, an image, or the like.
bool isOpaqueType(std::string_view word);

}  // namespace edgewise::vulkan
