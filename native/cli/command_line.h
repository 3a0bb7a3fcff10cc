// What the user asked for: the program's options, checked.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "atlas_refine/refine.h"

namespace atlas_refine::cli {

struct CommandLine {
  enum class Job { Refine, Measure, PrintText };
  Job job = Job::Refine;
  std::filesystem::path input;
  std::filesystem::path output;
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> svg_folder;
  RefineOptions options;
  bool json = false;  ///< measure: JSON instead of a table
  std::string text;   ///< PrintText: the help or the version
};

/// An option or argument that cannot be understood; what() is "<thing>: <what is wrong>".
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws UsageError.
CommandLine parse_command_line(int argc, char** argv);

}  // namespace atlas_refine::cli
