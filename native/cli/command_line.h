// What the user asked for: the program's options, checked.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "atlas_refine/refine.h"

namespace atlas_refine::cli {

struct CommandLine {
  enum class Job { Refine, Measure, PrintText };
  Job job = Job::Refine;
  std::vector<std::filesystem::path> inputs;  ///< several: a collection, one atlas
  std::filesystem::path output;               ///< of a collection: the folder
  std::optional<std::filesystem::path> report;
  std::optional<std::filesystem::path> svg_folder;
  std::optional<std::filesystem::path> trade_off;  ///< a CSV file; its picture lies beside it
  std::optional<std::filesystem::path> importance;
  std::string group_by = "none";  ///< none, material, object or tile
  std::optional<std::filesystem::path> keep_shape;
  std::optional<std::filesystem::path> locked;
  std::optional<std::filesystem::path> no_seam;
  std::optional<std::filesystem::path> prefer_seam;
  RefineOptions options;
  bool json = false;  ///< measure: JSON instead of a table
  std::string text;   ///< PrintText: the help or the version

  bool is_collection() const { return inputs.size() > 1; }
  std::filesystem::path trade_off_picture() const { return std::filesystem::path(*trade_off).replace_extension(".svg"); }
  /// Where the result of input `k` goes.
  std::filesystem::path output_of(int k) const { return is_collection() ? output / inputs[k].filename() : output; }
};

/// An option or argument that cannot be understood; what() is "<thing>: <what is wrong>".
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws UsageError.
CommandLine parse_command_line(int argc, char** argv);

}  // namespace atlas_refine::cli
