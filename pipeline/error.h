// Errors of the world (a file, a flag, a device): thrown where they are found, printed once by the program.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

namespace edgewise {

/// `text` with control characters replaced by '?': what files and users name must not break a line.
inline std::string oneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return text;
}

/// The input or the command line is wrong: exit status 2. Message "WHAT: WHY", one line.
struct InputError : std::runtime_error {
    InputError(const std::string& what, const std::string& why)
        : std::runtime_error(oneLine(what + ": " + why)) {}
};

/// The machine could not (memory, device, a stated limit): exit status 1.
struct FailureError : std::runtime_error {
    FailureError(const std::string& what, const std::string& why)
        : std::runtime_error(oneLine(what + ": " + why)) {}
};

/// The user pressed Ctrl-C: exit status 130.
struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace edgewise
