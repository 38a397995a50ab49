// --scene, --animation: an element of the file by its name, else by its index.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace edgewise {

/// The first element called `wanted`, else the one of that index. Throws InputError "FLAG WANTED: ...",
/// naming the file `source` and how many `kind` ("scenes") it has.
std::size_t chooseElement(const std::vector<std::string>& names, const std::string& wanted,
                          const std::string& flag, const std::string& source, const std::string& kind);

}  // namespace edgewise
