// A method's parameters as results name them.
#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/methods/method.h"

namespace edgewise {

/// {"number": K, parameter: value, ...}: every one with the value that is used, numbers as numbers; device
/// only where the method was typed with one. What is composed stands under its own name, as in
/// {"mask": "6x6", ..., "ssaa": {"number": 2}}, and so does a mesh that is made first.
nlohmann::ordered_json resolvedParameters(const MethodSpec& method);

}  // namespace edgewise
