#include "pipeline/cli/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "pipeline/error.h"
#include "pipeline/exit_status.h"
#include "pipeline/progress_bar.h"

namespace edgewise::cli {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may use it

/// Only what a signal handler may do.
void leaveAtOnce(int) {
    removePendingFile();
    wipeProgressLine();
    _exit(kInterruptedStatus);
}

void onInterrupt(int signal) {
    if (interrupted.exchange(true)) leaveAtOnce(signal);
    alarm(kGraceSeconds);
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
}

}  // namespace

void catchInterrupts() {
    handle(SIGALRM, leaveAtOnce);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, onInterrupt);
}

const std::atomic<bool>& interruptFlag() {
    return interrupted;
}

void throwIfInterrupted() {
    if (interrupted) throw Interrupted();
}

}  // namespace edgewise::cli
