// Ctrl-C: the first one asks the work to stop, and after a second stops waiting for it; so does another one.
#pragma once

#include <atomic>

namespace edgewise::cli {

/// How long work that does not ask whether it shall stop may go on: sorting, compression, a library's parser.
inline constexpr unsigned kGraceSeconds = 1;

/// From now on SIGINT, SIGTERM and SIGHUP set interruptFlag(); kGraceSeconds later, or at a second one, the
/// process ends. Either way nothing is left half-written.
void catchInterrupts();

const std::atomic<bool>& interruptFlag();

/// Throws Interrupted once Ctrl-C was pressed.
void throwIfInterrupted();

}  // namespace edgewise::cli
