// The values of command-line options, read strictly. Every error is an InputError "OPTION: WHY".
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "pipeline/film.h"

namespace edgewise::cli {

/// The whole of `text` as one finite number.
double parseNumber(const std::string& option, const std::string& text);

/// The whole of `text` as one integer in [least, most].
std::int64_t parseInteger(const std::string& option, const std::string& text, std::int64_t least,
                          std::int64_t most);

/// `X,Y` and `X,Y,Z`.
glm::dvec2 parsePair(const std::string& option, const std::string& text);
glm::dvec3 parseTriple(const std::string& option, const std::string& text);

/// `WxH`, each from 1 to kMaxFilmSide.
glm::ivec2 parseSize(const std::string& option, const std::string& text);

/// `X0,Y0,X1,Y1`, half-open and not empty; whether it lies inside the picture is checkCrop()'s question.
PixelBox parseCrop(const std::string& option, const std::string& text);
void checkCrop(const std::string& option, const PixelBox& crop, int width, int height);

}  // namespace edgewise::cli
