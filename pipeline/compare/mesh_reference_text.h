// What is said of a reference that is made of meshes of an SDF scene.
#pragma once

#include <string>

#include "pipeline/compare/comparison.h"

namespace edgewise::compare {

/// Lines for the console: the reference's meshes, then each row's error beside the reference's own. Empty
/// with any other reference.
std::string meshReferenceWords(const Comparison& comparison);
/// The same as a part of the page.
std::string meshReferenceHtml(const Comparison& comparison);

}  // namespace edgewise::compare
