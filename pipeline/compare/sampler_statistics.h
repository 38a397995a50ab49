// What is asked of a sampler's errors beyond their size: where there are few edges, and whether they have a
// bias.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "pipeline/compare/comparison.h"
#include "pipeline/methods/edge_classes.h"

namespace edgewise::compare {

/// RMSE over R, G and B of the pixels of EdgeClass::kFew; none where there are none. `errors` are
/// judge::signedErrors, `classes` of the same pixels.
std::optional<FewEdgesError> fewEdgesError(std::span<const glm::dvec3> errors,
                                           std::span<const EdgeClass> classes);

/// Half the width of the 95 % confidence interval of the mean signed error, by batch means: blocks of 8x8
/// pixels (cut at the right and the bottom) stand for independent draws, since neighbours that share samples
/// are correlated. `errors` in rows of `width`; none for fewer than 30 blocks.
std::optional<double> biasHalfWidth(std::span<const glm::dvec3> errors, int width);

}  // namespace edgewise::compare
