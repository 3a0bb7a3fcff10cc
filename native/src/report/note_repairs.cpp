// Repairs in words.
#include "report/note_repairs.h"

#include "atlas_refine/error.h"
#include "input/check_atlas.h"

namespace atlas_refine {

RepairOptions repair_options(const Refinement& run) { return {.open_closed = run.options.open_closed, .threads = run.threads}; }

std::vector<int> note_repairs(const Refinement& run, const RepairedCharts& repaired) {
  const auto number_of = [&](int chart) { return repaired.atlas.pieces[chart].mesh.number; };
  if (!repaired.unmended.empty()) {
    const UnmendedChart& first = repaired.unmended.front();
    const int number = number_of(first.chart);
    std::string message = message_prefix(run.input.atlas) + "chart " + std::to_string(number) + " " + first.reason;
    if (repaired.unmended.size() > 1) message += " (and " + std::to_string(repaired.unmended.size() - 1) + " more such charts)";
    throw RefineError(ErrorCode::BadInput, "repair", message, number, first.face);
  }
  std::vector<int> changed;
  for (const ChartRepair& repair : repaired.repairs) {
    run.journal.repairs.push_back({.what = in_words(repair),
                                   .charts = {number_of(repair.chart)},
                                   .faces = repair.faces,
                                   .distortion_to_input = repair.distortion_to_input});
    changed.push_back(repair.chart);
  }
  return changed;
}

}  // namespace atlas_refine
