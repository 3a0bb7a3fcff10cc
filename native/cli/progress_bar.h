// One line on stderr that shows how far the work is; nothing where stderr is not a terminal.
#pragma once

#include <chrono>

#include "atlas_refine/progress.h"

namespace atlas_refine::cli {

class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();  ///< wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  void show(const Progress& progress);

 private:
  bool on_terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace atlas_refine::cli
