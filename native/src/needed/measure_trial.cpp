// Measured on the pieces, and once more as stored where a limit depends on it.
#include "needed/measure_trial.h"

#include <limits>

#include "atlas_refine/error.h"
#include "measure/distortion.h"
#include "placing.h"
#include "report/certify.h"
#include "report/kept_faces.h"

namespace atlas_refine {
namespace {

/// A limit is asked, and kept.
bool seems_enough(const RefineOptions& asked, const Trial& trial) {
  const bool any = asked.max_distortion || asked.max_stretch;
  return any && trial.distortion <= asked.max_distortion.value_or(trial.distortion) &&
         trial.stretch <= asked.max_stretch.value_or(trial.stretch);
}

/// Parts of divided faces are polygons, which are read otherwise than their triangles lie in the solution.
void measure_as_stored(const Refinement& run, const Solution& solution, Trial& trial) {
  const Gap none{.value = 0};  // that it is kept is tested in the end
  try {
    const Measures after = certify(run.input, solution.atlas, none, run.asked).after;
    trial.distortion = after.distortion;
    trial.stretch = after.stretch_99;
  } catch (const RefineError& error) {
    if (error.code() != ErrorCode::NotCertified) throw;
    trial.distortion = trial.stretch = std::numeric_limits<double>::infinity();
  }
}

}  // namespace

void measure(const Refinement& run, const Solution& solution, Trial& trial) {
  const std::vector<Chart> charts = meshes_of(solution.atlas);
  trial.distortion = trial.stretch = std::numeric_limits<double>::infinity();
  if (!holds_bound(run, {.charts = charts, .frame = solution.atlas.frame})) return;
  const DirichletSums sums = dirichlet_sums(charts);
  trial.distortion = sums.best_energy();
  trial.stretch = stretch_99(charts, sums.best_scale());
  if (!solution.atlas.seams.empty() && divides_faces(run.options) && seems_enough(run.asked, trial))
    measure_as_stored(run, solution, trial);
}

}  // namespace atlas_refine
