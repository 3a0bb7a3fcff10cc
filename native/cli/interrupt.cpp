// Ctrl-C: ends the program at once where there is nothing to clean up, else asks the work to stop.
#include "interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace atlas_refine::cli {

namespace {

std::atomic<bool> stop_asked{false};
std::atomic<bool> work_can_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "needed inside a signal handler");

void on_interrupt(int) {
  if (!work_can_stop || stop_asked.exchange(true)) _exit(exit_interrupted);
}

}  // namespace

void install_interrupt_handler() { std::signal(SIGINT, on_interrupt); }

StopOnInterrupt::StopOnInterrupt() { work_can_stop = true; }
StopOnInterrupt::~StopOnInterrupt() { work_can_stop = false; }

bool interrupted() { return stop_asked; }

}  // namespace atlas_refine::cli
