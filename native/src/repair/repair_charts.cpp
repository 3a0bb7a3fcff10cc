// What is wrong with each chart, and the steps that may mend it.
#include "repair/repair_charts.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "cut/open_closed.h"
#include "geometry/guards.h"
#include "measure/bad_triangles.h"
#include "measure/certificate.h"
#include "measure/distortion.h"
#include "repair/convex_again.h"
#include "repair/embed.h"
#include "repair/part_touching.h"
#include "repair/untangle_chart.h"
#include "support/parallel.h"

namespace atlas_refine {
namespace {

using What = ChartRepair::What;

// E_2 above which an embedding anew may serve better, and E_d above which UVs have no shape worth keeping.
constexpr double kShapeLost = 1.5;
// E_2 up to which a chart that was mended in place needs no comparison with an embedding.
constexpr double kShapeKept = 1.02;

/// One chart after its repair, or why it has none.
struct Mended {
  CutAtlas atlas;  ///< of this chart alone
  What what = What::Embedded;
  std::string reason;  ///< empty where it was mended
};

Mended mended(const Chart& chart, What what) { return {.atlas = whole_atlas({chart}), .what = what, .reason = ""}; }
Mended unmended(const std::string& reason) { return {.atlas = {}, .what = What::Embedded, .reason = reason}; }

/// The face with a triangle that no UVs can give an area; -1 without one.
int face_of_repeated_vertex(const Chart& chart) {
  for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
    const Triangle& v = chart.triangles[t];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return chart.triangle_faces[t];
  }
  return -1;
}

bool any(const std::vector<char>& flags) { return std::find(flags.begin(), flags.end(), 1) != flags.end(); }

/// Nothing where that did not make it one piece that fits the plane.
std::optional<CutAtlas> opened(const Chart& chart, const SidePrices& prices) {
  std::vector<SurfacePath> paths;
  for (const auto& [from, to] : opening_edges(chart, prices)) paths.push_back({0, {from, to}});
  CutAtlas atlas = cut_along(whole_atlas({chart}), {chart}, paths);
  if (atlas.pieces.size() != 1 || !shape_of(atlas.pieces[0].mesh).fits_plane()) return std::nullopt;
  return atlas;
}

std::optional<Chart> embed_where(const std::optional<Spread>& start, const Chart& chart, Shapes shapes,
                                 const RepairOptions& options, Monitor& monitor) {
  if (!start) return std::nullopt;
  return embed(chart, *start, shapes, options.threads, monitor);
}

Mended opened_and_embedded(const Chart& chart, const ChartShape& shape, const SidePrices& prices, const RepairOptions& options,
                           Monitor& monitor) {
  const std::string what = shape.loops == 0 ? "has no boundary" : "has a handle";
  if (!options.open_closed) return unmended(what + ": it cannot be flat without a seam; --open-closed allows one");
  std::optional<CutAtlas> cut = opened(chart, prices);
  if (!cut) {
    const bool forbidden = !prices.empty() && opened(chart, {});
    return unmended(what + " and could not be opened" + (forbidden ? ": edges of --no-seam are in the way" : ""));
  }
  const auto start = spread_out(cut->pieces[0].mesh, options.threads, monitor);
  const auto embedded = embed_where(start, cut->pieces[0].mesh, Shapes::OfSurface, options, monitor);
  if (!embedded) return unmended(what + " and, opened, no embedding of acceptable distortion was found");
  cut->pieces[0].mesh = *embedded;
  return {.atlas = std::move(*cut), .what = What::Opened, .reason = ""};
}

double energy(const Chart& chart) { return dirichlet_sums(chart).best_energy(); }

/// The chart without overlap and its shape kept; nothing where there was none worth it, or it was lost all the same.
std::optional<Chart> drawn_apart(const Chart& chart, const std::optional<Spread>& start, const std::vector<char>& bad,
                                 const RepairOptions& options, Monitor& monitor) {
  if (mostly_bad(chart, bad) || !(sums_of_good(chart).best_energy() < kShapeLost)) return std::nullopt;
  const auto apart = embed_where(start, chart, Shapes::OfUvs, options, monitor);
  if (!apart || !(distortion_to_good(chart, *apart) < kShapeLost)) return std::nullopt;
  return apart;
}

/// The first of those that keep the good triangles' shapes best.
Mended best_kept(const Chart& chart, const std::vector<std::pair<std::optional<Chart>, What>>& candidates) {
  const Chart* best = nullptr;
  What what = What::Embedded;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [candidate, by] : candidates) {
    const double loss = candidate ? distortion_to_good(chart, *candidate) : least;
    if (loss < least) std::tie(best, what, least) = std::tuple(&*candidate, by, loss);
  }
  return mended(*best, what);
}

/// In place or at least with the good triangles' shapes; else in place or anew, whichever is less distorted.
Mended mend_disk(const Chart& chart, const std::vector<char>& bad, const RepairOptions& options, Monitor& monitor) {
  std::optional<Chart> in_place;
  double loss = std::numeric_limits<double>::infinity();  // of the good triangles' shapes, in place
  if (!any(bad)) {
    if (const auto parted = part_touching(chart)) return mended(*parted, What::Parted);
  } else if (!mostly_bad(chart, bad)) {
    in_place = untangle_chart(chart, options.may_overlap, options.threads, monitor);
    if (in_place && energy(*in_place) < kLine) loss = distortion_to_good(chart, *in_place);
    if (loss <= kShapeKept) return mended(*in_place, What::Untangled);
  }
  const bool kept = loss < kShapeLost;
  const auto start = spread_out(chart, options.threads, monitor);
  const auto apart = drawn_apart(chart, start, bad, options, monitor);
  if (apart && !kept) return mended(*apart, What::DrawnApart);
  const auto embedded = embed_where(start, chart, Shapes::OfSurface, options, monitor);
  if (kept) return best_kept(chart, {{in_place, What::Untangled}, {apart, What::DrawnApart}, {embedded, What::Embedded}});
  if (in_place && (!embedded || energy(*in_place) < energy(*embedded))) return mended(*in_place, What::Untangled);
  if (embedded) return mended(*embedded, What::Embedded);
  return unmended("overlaps itself and no embedding of acceptable distortion was found");
}

Mended mend(const Chart& chart, int index, const std::vector<char>& bad, const RepairOptions& options, Monitor& monitor) {
  const int repeated = face_of_repeated_vertex(chart);
  if (repeated >= 0) return unmended("has a face with two corners at one vertex: face " + std::to_string(repeated));
  const ChartShape shape = shape_of(chart);
  if (!shape.fits_plane()) {
    const SidePrices prices = options.prices.empty() ? SidePrices() : options.prices[index];
    return opened_and_embedded(chart, shape, prices, options, monitor);
  }
  return mend_disk(chart, bad, options, monitor);
}

/// Flipped triangles, overlaps, or borders that are apart by rounding only and can be parted; nothing where the chart is fine.
std::optional<Mended> mended_where_needed(const Chart& chart, int index, const std::vector<char>& bad,
                                          const RepairOptions& options, Monitor& monitor) {
  if (any(bad)) return mend(chart, index, bad, options, monitor);
  if (options.may_overlap) {
    if (!options.open_closed || shape_of(chart).fits_plane()) return std::nullopt;
    return mend(chart, index, bad, options, monitor);
  }
  if (!certify_charts({chart}).valid()) {
    const bool pinched = options.space_points && certify_charts({chart}, {(*options.space_points)[index]}).valid();
    return pinched ? std::nullopt : std::optional(mend(chart, index, bad, options, monitor));
  }
  if (!touches_itself(chart)) return std::nullopt;
  const auto parted = part_touching(chart);
  if (!parted) return std::nullopt;
  return mended(*parted, What::Parted);
}

/// A chart whose shape is to be kept must be valid as it is.
std::optional<Mended> unmended_where_invalid(const Chart& chart) {
  const Validity validity = certify_charts({chart});
  if (validity.valid()) return std::nullopt;
  return unmended("is to keep its shape, but " + validity.problem);
}

/// The faces of the bad triangles.
std::vector<int> faces_of(const Chart& chart, const std::vector<char>& bad) {
  std::set<int> faces;
  for (std::size_t t = 0; t < bad.size(); ++t) {
    if (bad[t]) faces.insert(chart.triangle_faces[t]);
  }
  return {faces.begin(), faces.end()};
}

/// Faces that are valid under every division.
std::set<int> faces_with_held_guards(Chart chart) {
  drop_broken_guards(chart);
  std::set<int> out;
  for (const Guard& guard : chart.guards) out.insert(guard.face);
  return out;
}

/// Without the guards that hold neither before the repair nor after it. The others are to hold: what was valid under every
/// division stays so.
Chart without_lost_guards(Chart mesh, const Chart& before) {
  const std::set<int> then = faces_with_held_guards(before), now = faces_with_held_guards(mesh);
  std::erase_if(mesh.guards, [&](const Guard& guard) { return !then.contains(guard.face) && !now.contains(guard.face); });
  return mesh;
}

void append(CutAtlas own, int chart, CutAtlas& all) {
  for (Piece& piece : own.pieces) {
    piece.chart = chart;
    all.pieces.push_back(std::move(piece));
  }
  for (const Seam& seam : own.seams) all.seams.push_back({chart, seam.ends});
}

/// The chart as it was, on the vertices of a piece that is the whole of it: where it was opened these are more.
Chart before_repair(const Chart& chart, const Piece& piece) {
  Chart before = piece.mesh;
  for (int v = 0; v < before.vertex_count(); ++v) before.uvs[v] = chart.uvs[piece.vertices[v]];
  return before;
}

void repair_chart(const Chart& chart, int index, const RepairOptions& options, Monitor& monitor, RepairedCharts& out) {
  const std::vector<char> bad = bad_triangles(chart);
  std::optional<Mended> result;
  if (bends(options.freedom, index)) result = mended_where_needed(chart, index, bad, options, monitor);
  if (!bends(options.freedom, index) && !is_fixed(options.freedom, index)) result = unmended_where_invalid(chart);
  if (!result || !result->reason.empty()) append(whole_atlas({chart}), index, out.atlas);
  if (!result) return;
  ChartRepair repair{.chart = index, .what = result->what, .faces = faces_of(chart, bad)};
  if (!result->reason.empty()) {
    out.unmended.push_back({index, repair.faces.empty() ? chart.triangle_faces.front() : repair.faces.front(), result->reason});
    return;
  }
  for (Piece& piece : result->atlas.pieces)
    piece.mesh = convex_again(without_lost_guards(piece.mesh, chart), options.may_overlap, options.threads, monitor);
  if (std::find(bad.begin(), bad.end(), 0) != bad.end()) {
    const Piece& piece = result->atlas.pieces[0];
    repair.distortion_to_input = distortion_to_good(before_repair(chart, piece), piece.mesh);
  }
  for (Piece& piece : result->atlas.pieces) drop_broken_guards(piece.mesh);
  append(std::move(result->atlas), index, out.atlas);
  out.repairs.push_back(repair);
}

}  // namespace

RepairedCharts repair_charts(const std::vector<Chart>& charts, const RepairOptions& options, Monitor& monitor) {
  const int count = static_cast<int>(charts.size());
  std::vector<RepairedCharts> of_chart(count);
  std::atomic<int> begun = 0;
  parallel_ranges(count, options.threads, 1, [&](int begin, int end) {
    for (int c = begin; c < end; ++c) {
      monitor.report(static_cast<double>(begun++) / count);
      repair_chart(charts[c], c, options, monitor, of_chart[c]);
    }
  });
  RepairedCharts out;
  for (RepairedCharts& own : of_chart) {
    std::move(own.atlas.pieces.begin(), own.atlas.pieces.end(), std::back_inserter(out.atlas.pieces));
    std::move(own.atlas.seams.begin(), own.atlas.seams.end(), std::back_inserter(out.atlas.seams));
    std::move(own.repairs.begin(), own.repairs.end(), std::back_inserter(out.repairs));
    std::move(own.unmended.begin(), own.unmended.end(), std::back_inserter(out.unmended));
  }
  return out;
}

std::string in_words(const ChartRepair& repair) {
  const std::string had = repair.faces.empty() ? "overlapped itself, " : "had flipped, zero-area or crushed faces, ";
  switch (repair.what) {
    case What::Parted:
      return "touched itself, touching borders drawn apart";
    case What::Untangled:
      return had + "mended in place";
    case What::DrawnApart:
      return had + "drawn apart, its shape kept";
    case What::Embedded:
      return had + "embedded anew";
    case What::Opened:
      return "had no boundary, or a handle: opened along edges, where a seam is now, and embedded anew";
  }
  return "";
}

}  // namespace atlas_refine
