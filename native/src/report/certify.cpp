// Storing, testing, measuring.
#include "report/certify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "atlas_refine/error.h"
#include "geometry/predicates.h"
#include "input/check_atlas.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "report/cut_faces.h"
#include "report/journal.h"
#include "report/kept_faces.h"
#include "report/locked.h"
#include "report/stored.h"
#include "report/texture.h"
#include "support/parallel.h"
#include "support/profile.h"

namespace atlas_refine {
namespace {

/// The faces of the charts that take part as they come out, and what each of their corners stands for.
CutFaces faces_of(const InputAtlas& input, const CutAtlas& atlas, const CutFaceOptions& options, bool divided) {
  if (divided) return cut_faces(input.atlas, input.set, atlas, options);
  CutFaces out;
  out.positions = input.atlas.positions;
  out.vertex_meshes = input.atlas.vertex_meshes;
  out.mesh.face_offsets = {0};
  const std::vector<CornerRef> corners = corners_on_pieces(input.atlas, input.set, atlas);
  for (int f = 0; f < input.atlas.face_count(); ++f) {
    if (corners[input.atlas.face_offsets[f]].chart < 0) continue;
    for (int c = input.atlas.face_offsets[f]; c < input.atlas.face_offsets[f + 1]; ++c) {
      out.mesh.corner_vertices.push_back(input.atlas.corner_vertices[c]);
      out.corners.push_back(corners[c]);
    }
    out.mesh.face_offsets.push_back(static_cast<int>(out.corners.size()));
  }
  return out;
}

class Refusal {
 public:
  Refusal(const Atlas& atlas) : prefix_(message_prefix(atlas) + "the result was withheld: ") {}
  [[noreturn]] void operator()(const std::string& why, int chart = -1, int face = -1) const {
    throw RefineError(ErrorCode::NotCertified, "certify", prefix_ + why, chart, face);
  }

 private:
  std::string prefix_;
};

/// Of the charts of the output, whose corners are those of pieces.
Freedoms freedom_of_output(const ChartSet& set, const std::vector<CornerRef>& corners, const Freedoms& of_pieces) {
  Freedoms out(of_pieces.empty() ? 0 : set.charts.size());
  for (std::size_t c = 0; c < corners.size() && !out.empty(); ++c) out[set.corners[c].chart] = of_pieces[corners[c].chart];
  return out;
}

/// As many charts as pieces, with as many vertices, have the seams that were meant.
void require_valid(const InputAtlas& input, const Atlas& output, const ChartSet& set, const Freedoms& freedom,
                   const std::vector<Chart>& pieces, bool cut) {
  const Refusal refuse(output);
  // Where faces of one chart are wound both ways, a part of it may be wound against the rest: it is not mirrored for that.
  const auto& mixed = input.set.mixed_winding;
  ChartSet oriented = set;
  if (cut && std::find(mixed.begin(), mixed.end(), true) != mixed.end()) {
    oriented.charts = charts_as_placed(set);
    oriented.mirrored.assign(set.mirrored.size(), false);
  }
  const Validity validity = validate_split(oriented, freedom);
  if (!validity.valid()) refuse(validity.problem, validity.chart, validity.face);
  const auto vertices = [](const std::vector<Chart>& charts) {
    int count = 0;
    for (const Chart& chart : charts) count += chart.vertex_count();
    return count;
  };
  if (set.charts.size() != pieces.size() || vertices(set.charts) != vertices(pieces))
    refuse("its seams are not those that were meant");
}

void require_gap(const Atlas& output, const std::vector<Chart>& stored, const Freedoms& freedom, const Gap& gap,
                 const RefineOptions& options) {
  const double aspect = options.box_aspect;
  const Vec2 box = is_in_texture(freedom, options) ? Vec2(aspect, 1) : box_of_aspect(uv_box(stored), aspect).size();
  const double between = gap_between_charts(stored, freedom);
  if (between >= gap.length(box)) return;
  Refusal refuse(output);
  refuse("two charts are " + number_text("%.6g", between / box.norm()) + " of the diagonal apart, nearer than the gap of " +
         number_text("%g", gap.value));
}

/// The border that the gap keeps free stays so.
void require_border(const Atlas& output, std::vector<Chart> stored, const Freedoms& freedom, const Vec2& origin,
                    const RefineOptions& options) {
  const double border = border_of(options), aspect = options.box_aspect;
  if (border == 0) return;
  const Vec2 corner = origin.cwiseProduct(Vec2(aspect, 1));
  for (Chart& chart : stored) {
    for (Vec2& uv : chart.uvs) uv -= corner;
  }
  // Single precision is coarser far from the first tile.
  const double rounding = 1e-6 * std::max(0.0, corner.cwiseAbs().maxCoeff() - 8);
  if (lies_in_texture(stored, freedom, aspect, kBorderSpare + rounding - border)) return;
  Refusal refuse(output);
  refuse("a chart is nearer to the border of the texture than the gap");
}

/// Guards are positive to the end: what is not is a fault of ours, but for those that are thin enough for single precision to
/// bend.
void require_guards(const Atlas& output, const std::vector<Chart>& stored, Stored precision) {
  for (int p = 0; p < static_cast<int>(stored.size()); ++p) {
    const std::vector<Vec2>& uvs = stored[p].uvs;
    for (const Guard& guard : stored[p].guards) {
      const Triangle& t = guard.triangle;
      if (orientation(uvs[t[0]], uvs[t[1]], uvs[t[2]]) > 0) continue;
      if (precision == Stored::Float32 && guard.share == 0) continue;
      Refusal refuse(output);
      refuse("face " + std::to_string(guard.face) + " is flipped for readers that divide it otherwise", p, guard.face);
    }
  }
}

/// Faces that lost a division that was positive in the input; `after` holds those that take part.
int worse_faces(const std::vector<FaceReading>& before, const std::vector<FaceReading>& after) {
  int count = 0;
  auto now = after.begin();
  for (const FaceReading& then : before) {
    if (then.chart < 0) continue;
    count += now->fan < then.fan || now->ears < then.ears || now->diagonals < then.diagonals;
    ++now;
  }
  return count;
}

/// Atlas::triangles on the corners of the faces that take part.
std::vector<std::array<int, 3>> readers_triangles(const InputAtlas& input) {
  std::vector<std::array<int, 3>> out;
  if (input.atlas.triangles.empty()) return out;
  std::vector<int> number;
  int count = 0;
  for (const CornerRef& corner : input.set.corners) number.push_back(corner.chart >= 0 ? count++ : -1);
  for (const auto& t : input.atlas.triangles) {
    if (number[t[0]] >= 0) out.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  return out;
}

int faces_among(const Chart& chart) {
  std::vector<int> faces = chart.triangle_faces;
  std::sort(faces.begin(), faces.end());
  return static_cast<int>(std::unique(faces.begin(), faces.end()) - faces.begin());
}

/// Linear texel density of UV area on surface area.
double density(double uv_area, double surface_area) { return surface_area > 0 ? std::sqrt(uv_area / surface_area) : 0; }

/// The largest finite stretch of a chart's triangles at the atlas' scale.
double largest_stretch(const Chart& chart, double scale) {
  const std::vector<double> stretch = triangle_stretch(chart, scale);
  return *std::max_element(stretch.begin(), stretch.end());
}

double surface_area(const std::vector<Chart>& charts) {
  double area = 0;
  for (const Chart& chart : charts) area += chart.surface.area();
  return area;
}

/// What each chart of the input has become; `charts` tells which of them each stored piece is part of.
std::vector<ChartReport> chart_reports(const InputAtlas& input, const std::vector<Chart>& stored,
                                       const std::vector<int>& charts) {
  const std::vector<Chart>& before = input.set.charts;
  const double scale = dirichlet_sums(stored).best_scale();
  const double mean_before = density(uv_area(before), surface_area(before));
  const double mean_after = density(uv_area(stored), surface_area(stored));
  std::vector<ChartReport> out(before.size());
  std::vector<DirichletSums> sums(before.size());
  std::vector<double> areas(before.size(), 0);
  for (std::size_t p = 0; p < stored.size(); ++p) {
    const int c = charts[p];
    out[c].stretch_max = std::max(out[c].stretch_max, largest_stretch(stored[p], scale));
    sums[c] += dirichlet_sums(stored[p]);
    areas[c] += uv_area(stored[p]);
  }
  for (std::size_t c = 0; c < before.size(); ++c) {
    ChartReport& report = out[c];
    report.faces = faces_among(before[c]);
    report.area = before[c].surface.area();
    report.mirrored = input.set.mirrored[c];
    report.distortion_before = dirichlet_sums(before[c]).best_energy();
    report.distortion_after = sums[c].best_energy();
    report.density_before = density(uv_area(before[c]), report.area) / mean_before;
    report.density_after = density(areas[c], report.area) / mean_after;
  }
  return out;
}

std::vector<PieceReport> piece_reports(const std::vector<Chart>& stored, const CutAtlas& atlas, const CutFaces& faces) {
  const double scale = dirichlet_sums(stored).best_scale();
  std::vector<PieceReport> out;
  for (std::size_t p = 0; p < stored.size(); ++p) {
    out.push_back({atlas.pieces[p].chart, 0, stored[p].surface.area(), dirichlet_sums(stored[p]).best_energy(),
                   largest_stretch(stored[p], scale)});
  }
  for (std::size_t f = 0; f + 1 < faces.mesh.face_offsets.size(); ++f)
    ++out[faces.corners[faces.mesh.face_offsets[f]].chart].faces;
  return out;
}

/// The pieces where the input's UVs have them.
std::vector<Chart> pieces_of_input(const InputAtlas& input, const CutAtlas& atlas) {
  std::vector<Chart> out = meshes_of(atlas);
  for (std::size_t p = 0; p < out.size(); ++p) {
    const Piece& piece = atlas.pieces[p];
    for (int v = 0; v < out[p].vertex_count(); ++v)
      out[p].uvs[v] = value_at(piece.supports[v], input.set.charts[piece.chart].uvs);
  }
  return out;
}

}  // namespace

CertifiedAtlas certify(const InputAtlas& input, const CutAtlas& atlas, const Gap& gap, const RefineOptions& options) {
  const PhaseScope scope(Phase::Certificate);
  const bool cut = !atlas.seams.empty() || !atlas.points.empty();
  CertifiedAtlas out{.stored = meshes_of(atlas)};
  out.uvs = stored_uvs(out.stored, atlas.frame, input.origin, options);
  const Freedoms of_charts = freedom_of(input.set, options), freedom = freedom_of_pieces(of_charts, atlas);
  restore_fixed(input, atlas, of_charts, out.uvs);
  for (std::size_t p = 0; p < out.stored.size(); ++p) out.stored[p].uvs = out.uvs[p];
  const bool divided = cut && divides_faces(options);
  CutFaces faces = faces_of(input, atlas, {out.uvs, options.triangulate}, divided);
  Atlas output{input.atlas.name, std::move(faces.positions), faces.mesh.face_offsets, faces.mesh.corner_vertices, {}};
  output.vertex_meshes = std::move(faces.vertex_meshes);
  if (!divided) output.triangles = readers_triangles(input);
  for (const CornerRef& corner : faces.corners) output.corner_uvs.push_back(out.uvs[corner.chart][corner.vertex]);
  double to_input = 0;
  const int threads = resolve_threads(options.threads);
  side_by_side(threads, {[&] {
                           ChartSet set = split_charts(output, Joining::Exact, {}, threads);
                           const Freedoms freedom_after = freedom_of_output(set, faces.corners, freedom);
                           excuse_fixed(set, freedom_after);
                           out.seams = seams_of(set);
                           out.triangulations = count_readings(set.readings);
                           out.mirrored_pieces = static_cast<int>(std::count(set.mirrored.begin(), set.mirrored.end(), true));
                           if (!divided) out.worse_faces = worse_faces(input.set.readings, set.readings);
                           require_valid(input, output, set, freedom_after, out.stored, cut);
                           stretch_to_texture(set.charts, options.box_aspect);
                           out.after = measure_split(set, options.box_aspect);
                           measure_in_texture(charts_as_placed(set), freedom_after, input.origin, options, out.after);
                         },
                         [&] {
                           require_guards(output, out.stored, options.stored);
                           stretch_to_texture(out.stored, options.box_aspect);
                           require_gap(output, out.stored, freedom, gap, options);
                           require_border(output, out.stored, freedom, input.origin, options);
                           // The same triangles in the same order as the input's: only then can E_2 be told.
                           to_input = dirichlet_sums_between(pieces_of_input(input, atlas), out.stored).best_energy();
                           out.charts = chart_reports(input, out.stored, charts_of(atlas));
                           if (cut) out.pieces = piece_reports(out.stored, atlas, faces);
                         }});
  out.after.distortion_to_input = to_input;
  return out;
}

std::vector<int> charts_lost_to_rounding(const InputAtlas& input, const CutAtlas& atlas, const RefineOptions& options) {
  const auto uvs = stored_uvs(meshes_of(atlas), atlas.frame, input.origin, options);
  const auto positive = [](const std::vector<Vec2>& at, const Triangle& t) {
    return orientation(at[t[0]], at[t[1]], at[t[2]]) > 0;
  };
  std::set<int> out;
  for (std::size_t p = 0; p < atlas.pieces.size(); ++p) {
    const Chart& mesh = atlas.pieces[p].mesh;
    const bool lost = std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                                  [&](const Triangle& t) { return positive(mesh.uvs, t) && !positive(uvs[p], t); });
    if (lost) out.insert(mesh.number);
  }
  return {out.begin(), out.end()};
}

std::vector<ChartReport> reports_of_input(const InputAtlas& input) {
  std::vector<int> own(input.set.charts.size());
  std::iota(own.begin(), own.end(), 0);
  return chart_reports(input, input.set.charts, own);
}

}  // namespace atlas_refine
