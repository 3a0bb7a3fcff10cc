// The one exception type of the library. It names what failed, where, and on which chart and face.
#pragma once

#include <stdexcept>
#include <string>

namespace atlas_refine {

enum class ErrorCode {
  BadOption,        ///< an option is out of its range
  BadInput,         ///< the atlas cannot be used: indices, NaN, flips, zero-area UV faces, ...
  BoundNotReached,  ///< no valid atlas at the bound, or none within max_distortion and max_stretch; the message names the best
                    ///< one's PE and E_d
  NotCertified,     ///< a result failed the exact certificate and was withheld
  Cancelled,        ///< the progress callback asked to stop
};

/// Stable lower-case name of a code ("bad_option", ...), used in reports and in Python.
const char* to_string(ErrorCode code);

class RefineError : public std::runtime_error {
 public:
  /// `chart` and `face` are 0-based indices into the input's charts and polygons, -1 where none applies.
  RefineError(ErrorCode code, std::string stage, const std::string& message, int chart = -1, int face = -1);

  ErrorCode code() const { return code_; }
  const std::string& stage() const { return stage_; }
  int chart() const { return chart_; }
  int face() const { return face_; }

 private:
  ErrorCode code_;
  std::string stage_;
  int chart_;
  int face_;
};

}  // namespace atlas_refine
