// Measured on the pieces, or as stored where these are read otherwise.
#include "needed/measure_trial.h"

#include <limits>

#include "atlas_refine/error.h"
#include "measure/distortion.h"
#include "placing.h"
#include "report/certify.h"
#include "report/kept_faces.h"

namespace atlas_refine {
namespace {

/// Of triangles all parts are images of one map, however they are divided.
bool divides_polygons(const Refinement& run, const CutAtlas& atlas) {
  const Atlas& input = run.input.atlas;
  return !atlas.seams.empty() && divides_faces(run.options) && input.corner_count() > 3 * input.face_count();
}

/// Parts of divided polygons are polygons, which are read otherwise than their triangles lie in the solution.
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
  if (divides_polygons(run, solution.atlas)) measure_as_stored(run, solution, trial);
}

}  // namespace atlas_refine
