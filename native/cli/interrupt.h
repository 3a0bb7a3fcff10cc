// Ctrl-C: ends the program at once where there is nothing to clean up, else asks the work to stop.
#pragma once

namespace atlas_refine::cli {

constexpr int exit_interrupted = 130;

/// From here on Ctrl-C ends the program with exit_interrupted.
void install_interrupt_handler();

/// While one of these lives, the first Ctrl-C only sets the flag that `interrupted` tells; the second ends the program.
class StopOnInterrupt {
 public:
  StopOnInterrupt();
  ~StopOnInterrupt();
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;
};

bool interrupted();

}  // namespace atlas_refine::cli
