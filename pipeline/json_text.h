// JSON as text, whatever bytes its strings have.
#pragma once

#include <string>

namespace edgewise {

/// JSON text is UTF-8: bytes of a name or a command line that are not become U+FFFD. Without `indent` one
/// line.
template <class Json>
std::string jsonText(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace edgewise
