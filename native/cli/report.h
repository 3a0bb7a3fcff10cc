// What the program tells: a JSON report, a summary for people, the table of `measure`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "atlas_refine/measures.h"
#include "command_line.h"

namespace atlas_refine::cli {

/// Wall-clock seconds of one run of the program, and the processor's for its files.
struct Times {
  double read = 0;
  double refine = 0;
  double write = 0;
  double files = 0;
};

/// One input, and what became of it.
struct FileReport {
  std::filesystem::path input;
  std::filesystem::path output;
  int faces = 0;
  int added_faces = 0;
  int vertices = 0;
  int added_vertices = 0;
};

/// What is said of a repair.
using RepairWords = std::function<std::string(const Repair&)>;

/// Everything about a run, for programs. Infinite values become null.
std::string json_report(const CommandLine& line, const std::vector<FileReport>& files, const RefineResult& result,
                        const Times& times, const RepairWords& words = describe);

/// A few lines about a run, for people.
std::string summary(const std::vector<FileReport>& files, const RefineResult& result, const Times& times,
                    const RepairWords& words = describe);

/// `notes` say what of the file is not in the atlas.
std::string measures_json(const std::string& input, const Measures& measures, const Validity& validity,
                          const std::vector<std::string>& notes);
std::string measures_table(const Measures& measures, const Validity& validity, const std::vector<std::string>& notes);

}  // namespace atlas_refine::cli
