// Values of a document, checked: every error is a SceneError of path and rule.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sdf/parse_json.h"
#include "sdf/tree.h"

namespace edgewise::sdf {

[[noreturn]] void refuse(const std::string& path, const std::string& rule);

/// Throws unless `value` is an object.
void requireObject(const Json& value, const std::string& path);
/// Throws for a key that is not among `known`, naming what was meant.
void requireKnownKeys(const Json& object, const std::string& path,
                      const std::vector<std::string_view>& known);

/// A number, or three, appended to `to`. What is not negative and below kSmallest counts as 0.
void readNumbers(const Json& value, const std::string& path, const NumberInfo& info, std::vector<double>& to);
/// At most 255 bytes.
std::string readText(const Json& value, const std::string& path);
bool readFlag(const Json& value, const std::string& path);
/// The index of one of the options.
std::size_t readChoice(const Json& value, const std::string& path,
                       const std::vector<std::string_view>& options);

}  // namespace edgewise::sdf
