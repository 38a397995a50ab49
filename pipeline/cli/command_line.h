// The command as text, for the metadata of outputs.
#pragma once

#include <span>
#include <string>

namespace edgewise::cli {

/// "edgewise" and the arguments, each quoted where a shell would need it.
std::string quoteCommandLine(std::span<char* const> arguments);

}  // namespace edgewise::cli
