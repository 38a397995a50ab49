// Errors of the world (a file, a flag, a device): thrown where they are found, printed once by the program.
#pragma once

#include <stdexcept>
#include <string>

namespace edgewise {

/// The input or the command line is wrong: exit status 2. Message "WHAT: WHY", one line.
struct InputError : std::runtime_error {
    InputError(const std::string& what, const std::string& why) : std::runtime_error(what + ": " + why) {}
};

/// The machine could not (memory, device, a stated limit): exit status 1.
struct FailureError : std::runtime_error {
    FailureError(const std::string& what, const std::string& why) : std::runtime_error(what + ": " + why) {}
};

/// The user pressed Ctrl-C: exit status 130.
struct Interrupted : std::runtime_error {
    Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace edgewise
