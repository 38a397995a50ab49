#include "pipeline/cli/command_line.h"

#include <string_view>

namespace edgewise::cli {
namespace {

constexpr std::string_view kPlainCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";

std::string quote(std::string_view argument) {
    if (!argument.empty() && argument.find_first_not_of(kPlainCharacters) == std::string_view::npos)
        return std::string(argument);
    std::string quoted = "'";
    for (const char c : argument) quoted.append(c == '\'' ? "'\\''" : std::string(1, c));
    return quoted + "'";
}

}  // namespace

std::string quoteCommandLine(std::span<char* const> arguments) {
    std::string text = "edgewise";
    for (const char* argument : arguments) text.append(1, ' ').append(quote(argument));
    return text;
}

}  // namespace edgewise::cli
