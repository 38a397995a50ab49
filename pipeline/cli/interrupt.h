// Ctrl-C: the first one asks the work to stop, the second one does not wait for it.
#pragma once

#include <atomic>

namespace edgewise::cli {

inline constexpr int kInterruptedStatus = 130;

/// From now on SIGINT sets interruptFlag(); a second one ends the process at once, leaving nothing
/// half-written.
void catchInterrupts();

const std::atomic<bool>& interruptFlag();

/// Throws Interrupted once Ctrl-C was pressed.
void throwIfInterrupted();

}  // namespace edgewise::cli
