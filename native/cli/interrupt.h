// Ctrl-C: asks the work to stop, and ends the program where that takes too long and nothing has to be cleaned up.
#pragma once

namespace atlas_refine::cli {

constexpr int exit_interrupted = 130;

enum class OnInterrupt {
  Exit,        ///< end the program at once
  AskAndExit,  ///< set the flag `interrupted` tells; end the program if it still runs after 0.3 s
  Ask,         ///< set the flag only: files are being written
};

/// From here on Ctrl-C ends the program with exit_interrupted.
void install_interrupt_handler();

/// What Ctrl-C does while this lives.
class InterruptScope {
 public:
  explicit InterruptScope(OnInterrupt action);
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

 private:
  OnInterrupt outer_;
};

bool interrupted();

}  // namespace atlas_refine::cli
