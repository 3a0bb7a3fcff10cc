// Input to charts (section 3, "Inputs"), from top to bottom: `split_charts` is the whole way.
#include "input/split_charts.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "atlas_refine/error.h"
#include "geometry/half_edge_mesh.h"
#include "geometry/plane.h"
#include "input/check_atlas.h"
#include "input/face_areas.h"
#include "input/part_folds.h"
#include "input/settle_noise.h"
#include "input/surfaces.h"
#include "support/disjoint_sets.h"
#include "support/parallel.h"
#include "support/profile.h"

namespace atlas_refine {

namespace {

constexpr int kFewCorners = 20000;  // are not worth a second thread

/// The chart of every face; charts are ordered by their smallest face.
struct FaceCharts {
  std::vector<int> chart;  ///< one per face
  int count = 0;
};

FaceCharts number_charts(const Atlas& atlas, const EdgeJoins& joins) {
  DisjointSets joined = joined_faces(atlas, joins);
  FaceCharts charts;
  charts.chart.reserve(atlas.face_count());
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int first = joined.find(f);
    charts.chart.push_back(first == f ? charts.count++ : charts.chart[first]);
  }
  return charts;
}

struct ChartSides {
  std::vector<bool> mirrored;      ///< one per chart
  std::vector<bool> mixed;         ///< one per chart: its faces are wound both ways
  std::vector<bool> turned_faces;  ///< one per face: it runs backwards in its chart
};

/// The way in which the larger part of a chart's faces lies in the UV plane: by area in space, which a few faces drawn out over
/// the whole map do not sway, else by area in the plane.
struct Vote {
  double in_space = 0, in_plane = 0;

  void add(double doubled_in_space, double doubled_in_plane) {
    in_plane += doubled_in_plane;
    if (doubled_in_plane != 0) in_space += doubled_in_plane > 0 ? doubled_in_space : -doubled_in_space;
  }
  bool negative() const { return in_space != 0 ? in_space < 0 : in_plane < 0; }
};

/// A chart is mirrored where the larger part of it lies clockwise as the input winds it; one whose faces are wound both ways is
/// not: they do not agree on it. Then u is negated.
/// Either way its faces are turned together so that the chart's area is positive; faces that are not are defects.
ChartSides orient_charts(const Atlas& atlas, const EdgeJoins& joins, const FaceCharts& charts) {
  std::vector<Vote> as_wound(charts.count), as_joined(charts.count);
  for (int f = 0; f < atlas.face_count(); ++f) {
    const double in_space = doubled_area_in_space(atlas, f), in_plane = doubled_uv_area(atlas, f);
    as_wound[charts.chart[f]].add(in_space, in_plane);
    as_joined[charts.chart[f]].add(in_space, joins.turned_faces[f] ? -in_plane : in_plane);
  }
  ChartSides sides{std::vector<bool>(charts.count), std::vector<bool>(charts.count), joins.turned_faces};
  for (int f = 0; f < atlas.face_count(); ++f) {
    if (joins.turned_faces[f]) sides.mixed[charts.chart[f]] = true;  // against the chart's first face
  }
  for (int k = 0; k < charts.count; ++k) sides.mirrored[k] = as_wound[k].negative() && !sides.mixed[k];
  for (int f = 0; f < atlas.face_count(); ++f) {
    const int k = charts.chart[f];
    if (as_joined[k].negative() != sides.mirrored[k]) sides.turned_faces[f] = !sides.turned_faces[f];
  }
  return sides;
}

/// The parted edges, gathered by what was one chart.
std::vector<Fold> folds_of(const Atlas& atlas, const EdgeJoins& joins, const std::vector<CornerRef>& corners, int chart_count,
                           const std::vector<std::array<int, 2>>& parted) {
  DisjointSets whole(chart_count);
  for (const auto& [c, other] : parted) whole.unite(corners[c].chart, corners[other].chart);
  std::map<int, Fold> folds;  // by the first chart
  for (const auto& [c, other] : parted) {
    std::array<int, 2> ends{other, joins.next_corner(atlas, other)};  // where this side starts, and where it ends
    if (!joins.alike[c]) std::swap(ends[0], ends[1]);
    folds[whole.find(corners[c].chart)].edges.push_back(
        {{corners[c].chart, corners[other].chart},
         {{{corners[c].vertex, corners[ends[0]].vertex}, {corners[joins.next_corner(atlas, c)].vertex, corners[ends[1]].vertex}}},
         c});
  }
  std::vector<Fold> out;
  for (auto& [first, fold] : folds) {
    for (const FoldEdge& edge : fold.edges) fold.charts.insert(fold.charts.end(), edge.charts.begin(), edge.charts.end());
    std::sort(fold.charts.begin(), fold.charts.end());
    fold.charts.erase(std::unique(fold.charts.begin(), fold.charts.end()), fold.charts.end());
    out.push_back(std::move(fold));
  }
  return out;
}

/// UV vertices: corners united across joined edges, so that each has one fan of faces.
std::vector<CornerRef> number_vertices(const Atlas& atlas, const EdgeJoins& joins, const FaceCharts& charts) {
  DisjointSets sets(atlas.corner_count());
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const int partner = joins.partners[c];
    if (partner < c) continue;
    const int c_end = joins.next_corner(atlas, c), partner_end = joins.next_corner(atlas, partner);
    const bool alike = joins.turned_faces[joins.corner_faces[c]] == joins.turned_faces[joins.corner_faces[partner]];
    sets.unite(c, alike ? partner_end : partner);
    sets.unite(c_end, alike ? partner : partner_end);
  }
  std::vector<CornerRef> corners;
  corners.reserve(atlas.corner_count());
  std::vector<int> counts(charts.count, 0);
  for (int c = 0; c < atlas.corner_count(); ++c) {
    const int k = charts.chart[joins.corner_faces[c]];
    const int first = sets.find(c);
    corners.push_back(first == c ? CornerRef{k, counts[k]++} : corners[first]);
  }
  return corners;
}

/// For every vertex of every chart the value at the first of its corners.
template <class Value, class ValueAt>
std::vector<std::vector<Value>> at_vertices(const std::vector<CornerRef>& corners, std::size_t chart_count, ValueAt value_at) {
  std::vector<std::vector<Value>> values(chart_count);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (corners[c].chart < 0) continue;
    auto& of_chart = values[corners[c].chart];
    if (corners[c].vertex == static_cast<int>(of_chart.size())) of_chart.push_back(value_at(static_cast<int>(c)));
  }
  return values;
}

std::vector<Chart> charts_with_uvs(const Atlas& atlas, const ChartSet& set, Joining joining) {
  const std::vector<CornerRef>& corners = set.corners;
  const std::vector<bool>& mirrored = set.mirrored;
  auto uvs = at_vertices<Vec2>(corners, mirrored.size(), [&](int c) { return atlas.corner_uvs[c]; });
  if (joining == Joining::AsMeant) settle_noise(atlas, corners, set.points, uvs);
  std::vector<Chart> charts(mirrored.size());
  for (std::size_t k = 0; k < charts.size(); ++k) {
    charts[k].uvs = std::move(uvs[k]);
    if (!mirrored[k]) continue;
    for (Vec2& uv : charts[k].uvs) uv.x() = -uv.x();
  }
  return charts;
}

std::vector<std::vector<Vec3>> vertex_positions(const Atlas& atlas, const std::vector<CornerRef>& corners, std::size_t count) {
  return at_vertices<Vec3>(corners, count, [&](int c) { return atlas.positions[atlas.corner_vertices[c]]; });
}

/// The loop of largest area in the UV plane first.
std::vector<std::vector<int>> boundary_loops(const Chart& chart) {
  std::vector<std::vector<int>> loops = mesh_topology(chart.vertex_count(), chart.triangles).boundary_loops;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const std::vector<int>& loop = loops[i];
    double sum = 0;
    for (std::size_t j = 2; j < loop.size(); ++j) {
      sum += doubled_area(chart.uvs[loop[0]], chart.uvs[loop[j - 1]], chart.uvs[loop[j]]);
    }
    order.push_back({-std::abs(sum), i});
  }
  std::sort(order.begin(), order.end());
  std::vector<std::vector<int>> sorted;
  for (const auto& [area, i] : order) sorted.push_back(std::move(loops[i]));
  return sorted;
}

}  // namespace

ChartSet split_charts(const Atlas& atlas, Joining joining, const std::vector<int>& groups, int threads) {
  const PhaseScope scope(Phase::Input);
  check_atlas(atlas);
  if (atlas.corner_count() < kFewCorners) threads = 1;
  EdgeJoins joins = join_edges(atlas, joining, groups, threads);
  std::vector<std::array<int, 2>> parted;
  if (joining == Joining::AsMeant) parted = part_folds(atlas, joins);
  const FaceCharts face_charts = number_charts(atlas, joins);
  ChartSet set;
  ChartSides sides;
  side_by_side(threads, {[&] { set.corners = number_vertices(atlas, joins, face_charts); },
                         [&] { sides = orient_charts(atlas, joins, face_charts); }});
  set.seam_edges = joins.seam_edges;
  set.seam_length = joins.seam_length;
  set.open_length = joins.open_length;
  set.folds = folds_of(atlas, joins, set.corners, face_charts.count, parted);
  set.mirrored = sides.mirrored;
  set.mixed_winding = sides.mixed;
  const auto points_and_uvs = [&] {
    set.points = at_vertices<int>(set.corners, face_charts.count, [&](int c) { return joins.places[atlas.corner_vertices[c]]; });
    set.charts = charts_with_uvs(atlas, set, joining);
  };
  std::vector<std::vector<Vec3>> positions;
  side_by_side(threads, {points_and_uvs, [&] { positions = vertex_positions(atlas, set.corners, face_charts.count); }});
  FaceTriangles faces = triangulate_faces(atlas, set.corners, sides.turned_faces, set.charts);
  set.defects = std::move(faces.defects);
  set.readings = std::move(faces.readings);
  side_by_side(threads, {[&] { set_surfaces(set.charts, positions); },
                         [&] {
                           for (Chart& chart : set.charts) chart.boundary_loops = boundary_loops(chart);
                         }});
  for (std::size_t k = 0; k < set.charts.size(); ++k) set.charts[k].number = static_cast<int>(k);
  return set;
}

ChartSet select_charts(const ChartSet& set, const std::vector<int>& charts) {
  ChartSet out;
  std::vector<int> index(set.charts.size(), -1);
  for (const int k : charts) {
    index[k] = static_cast<int>(out.charts.size());
    out.charts.push_back(set.charts[k]);
    out.points.push_back(set.points[k]);
    out.mirrored.push_back(set.mirrored[k]);
    out.mixed_winding.push_back(set.mixed_winding[k]);
  }
  out.corners = set.corners;
  for (CornerRef& corner : out.corners) corner.chart = corner.chart < 0 ? -1 : index[corner.chart];
  out.readings = set.readings;
  for (FaceReading& reading : out.readings) reading.chart = reading.chart < 0 ? -1 : index[reading.chart];
  for (const FaceDefect& defect : set.defects) {
    if (index[defect.chart] >= 0) out.defects.push_back({index[defect.chart], defect.face, defect.kind});
  }
  return out;
}

std::vector<Chart> charts_as_placed(const ChartSet& set) {
  std::vector<Chart> charts = set.charts;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    if (!set.mirrored[k]) continue;
    for (Vec2& uv : charts[k].uvs) uv.x() = -uv.x();
    turn_triangles_over(charts[k]);
    for (std::vector<int>& loop : charts[k].boundary_loops) std::reverse(loop.begin(), loop.end());
  }
  return charts;
}

}  // namespace atlas_refine
