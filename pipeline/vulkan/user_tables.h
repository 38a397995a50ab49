// Constant tables of a user's text.
#pragma once

#include <vector>

#include "pipeline/vulkan/glsl_tokens.h"
#include "pipeline/vulkan/text_edits.h"

namespace edgewise::vulkan {

/// `const float a[N] = float[N](...)`: SPIR-V knows no constants that are read at an index, so that a
/// compiler stores the whole table before each reading; lavapipe takes minutes over one of 256. Readings a[i]
/// become calls of a function that compares i with every index; beyond the table it gives the first entry.
/// Does nothing for other parts, and for a name that is declared again elsewhere.
void readByComparisons(const std::vector<GlslToken>& tokens, const GlslPart& part, Edits& edits);

}  // namespace edgewise::vulkan
