// Small charts and their gap.
#include "reduce/specks.h"

#include "measure/distortion.h"

namespace atlas_refine {
namespace {

constexpr double kInShape = 1.1;  // E_d of a chart that is worth keeping as it is

}  // namespace

Freedoms with_specks_held(const CutAtlas& atlas, Freedoms freedom, const Gap& gap, double pe_bound, double box_aspect) {
  double area = 0;
  for (const Piece& piece : atlas.pieces) area += uv_area(piece.mesh);
  const double least = gap.length(sides_of_area(area / pe_bound, box_aspect));
  for (std::size_t p = 0; p < atlas.pieces.size(); ++p) {
    const Chart& chart = atlas.pieces[p].mesh;
    if (!bends(freedom, p) || box_of_points(chart.uvs).diagonal() > least) continue;
    if (dirichlet_sums(chart).best_energy() > kInShape) continue;
    if (freedom.empty()) freedom.assign(atlas.pieces.size(), Freedom::Bends);
    freedom[p] = Freedom::Moves;
  }
  return freedom;
}

}  // namespace atlas_refine
