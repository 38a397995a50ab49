#include "pipeline/cli/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "pipeline/error.h"

namespace edgewise::cli {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may use it

void onInterrupt(int) {
    if (!interrupted.exchange(true)) return;
    removePendingFile();
    _exit(kInterruptedStatus);
}

}  // namespace

void catchInterrupts() {
    struct sigaction action = {};
    action.sa_handler = onInterrupt;
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
}

const std::atomic<bool>& interruptFlag() {
    return interrupted;
}

void throwIfInterrupted() {
    if (interrupted) throw Interrupted();
}

}  // namespace edgewise::cli
