// Ctrl-C: asks the work to stop, and ends the program where that takes too long and nothing has to be cleaned up.
#include "interrupt.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

namespace atlas_refine::cli {

namespace {

std::atomic<bool> stop_asked{false};
std::atomic<OnInterrupt> action_now{OnInterrupt::Exit};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<OnInterrupt>::is_always_lock_free,
              "needed inside a signal handler");

void on_patience_over(int) {
  if (action_now != OnInterrupt::Ask) _exit(exit_interrupted);
}

void on_interrupt(int) {
  stop_asked = true;
  if (action_now == OnInterrupt::Exit) _exit(exit_interrupted);
  itimerval patience{};
  patience.it_value.tv_usec = 300'000;
  setitimer(ITIMER_REAL, &patience, nullptr);
}

}  // namespace

void install_interrupt_handler() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGALRM, on_patience_over);
}

InterruptScope::InterruptScope(OnInterrupt action) : outer_(action_now.exchange(action)) {}
InterruptScope::~InterruptScope() { action_now = outer_; }

bool interrupted() { return stop_asked; }

}  // namespace atlas_refine::cli
