// One line on stderr that shows how far the work is; nothing where stderr is not a terminal.
#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace atlas_refine::cli {

ProgressBar::ProgressBar() : on_terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(const Progress& progress) {
  const auto now = std::chrono::steady_clock::now();
  if (!on_terminal_ || (shown_ && now - last_ < std::chrono::milliseconds(50))) return;
  constexpr int width = 30;
  const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
  const int filled = static_cast<int>(fraction * width);
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  std::fprintf(stderr, "\r\033[K%-8s [%s] %3.0f %%", progress.stage.c_str(), bar.c_str(), 100 * fraction);
  if (progress.pe > 0) std::fprintf(stderr, "  PE %.4f", progress.pe);
  std::fflush(stderr);
  shown_ = true;
  last_ = now;
}

}  // namespace atlas_refine::cli
