// What the program tells: a JSON report, a summary for people, the table of `measure`.
#pragma once

#include <string>

#include "atlas_refine/measures.h"
#include "command_line.h"

namespace atlas_refine::cli {

/// Wall-clock seconds of one run of the program.
struct Times {
  double read = 0;
  double refine = 0;
  double write = 0;
};

/// Everything about a run, for programs. Infinite values become null.
std::string json_report(const CommandLine& line, const RefineResult& result, const Times& times);

/// A few lines about a run, for people.
std::string summary(const RefineResult& result, const Times& times);

std::string measures_json(const std::string& input, const Measures& measures, const Validity& validity);
std::string measures_table(const Measures& measures, const Validity& validity);

}  // namespace atlas_refine::cli
