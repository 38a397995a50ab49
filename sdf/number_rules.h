// What the numbers of a scene may be: one statement of each rule for the reader, its messages and the schema.
#pragma once

#include <string>

#include "sdf/parse_json.h"
#include "sdf/tree.h"

namespace edgewise::sdf {

/// Of sizes and lengths: less is no size that float arithmetic can work with.
inline constexpr double kSmallest = 1e-6;

/// "above 0, from 1e-06 to 1e+06"; of one component.
std::string ruleOf(const NumberInfo& info);

/// One component.
bool obeys(const NumberInfo& info, double value);

/// The JSON schema of one component, and of the number or vector.
Json schemaOf(const NumberInfo& info);

}  // namespace edgewise::sdf
