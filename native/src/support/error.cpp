// The library's exception type and its names.
#include "atlas_refine/error.h"

namespace atlas_refine {

const char* to_string(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadOption:
      return "bad_option";
    case ErrorCode::BadInput:
      return "bad_input";
    case ErrorCode::BoundNotReached:
      return "bound_not_reached";
    case ErrorCode::NotCertified:
      return "not_certified";
    case ErrorCode::Cancelled:
      return "cancelled";
  }
  return "unknown";
}

RefineError::RefineError(ErrorCode code, std::string stage, const std::string& message, int chart, int face)
    : std::runtime_error(message), code_(code), stage_(std::move(stage)), chart_(chart), face_(face) {}

}  // namespace atlas_refine
