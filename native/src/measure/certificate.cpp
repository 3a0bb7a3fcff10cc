// The validity certificate: exact predicates on the values that are stored.
//
// A chart whose triangles are all positive covers each point of the plane as often as its boundary winds around it. So charts
// are embedded, and apart from each other, exactly where (1) every triangle is positive, (2) no two boundary edges touch, and
// (3) the boundaries together wind once around the points just left of every loop. (3) finds what the boundaries alone do not
// show: a chart inside another, and a chart that folds over itself around a branch point.
#include "measure/certificate.h"

#include <limits>
#include <sstream>
#include <string>

#include "geometry/predicates.h"
#include "measure/boundary_edges.h"

namespace atlas_refine {

namespace {

constexpr int kMostCrossings = 10000;  // counting stops here: stacked charts cross a quadratic number of times

const double kTouching = 0;

std::string place(const Vec2& p) {
  std::ostringstream text;
  text << '(' << p.x() << ", " << p.y() << ')';
  return text.str();
}

/// What messages call a chart: its number in the input where it has one.
int name_of(const std::vector<Chart>& charts, int chart) { return charts[chart].number >= 0 ? charts[chart].number : chart; }

void note(Validity& validity, const std::string& problem, int chart, int face = -1) {
  if (!validity.valid()) return;
  validity.problem = problem;
  validity.chart = chart;
  validity.face = face;
}

void check_triangles(const std::vector<Chart>& charts, const Freedoms& freedom, Validity& validity) {
  for (std::size_t k = 0; k < charts.size(); ++k) {
    if (is_fixed(freedom, k)) continue;
    const Chart& chart = charts[k];
    int last_face = -1;
    for (std::size_t t = 0; t < chart.triangles.size(); ++t) {
      const Triangle& v = chart.triangles[t];
      const int face = chart.triangle_faces[t];
      const int sign = orientation(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]);
      if (sign > 0 || face == last_face) continue;
      last_face = face;
      ++validity.flipped_faces;
      const std::string what = sign == 0 ? " has no area in the UV map" : " is flipped in the UV map";
      const int name = name_of(charts, static_cast<int>(k));
      note(validity, "face " + std::to_string(face) + " of chart " + std::to_string(name) + what, name, face);
    }
  }
}

/// Whether two boundary edges share more than the common vertex that neighbours in a loop have.
bool in_contact(const BoundaryEdge& a, const BoundaryEdge& b) {
  if (a.chart == b.chart) {
    const bool b_follows = a.to_vertex == b.from_vertex, a_follows = b.to_vertex == a.from_vertex;
    if (b_follows && a_follows) return true;
    if (b_follows || a_follows) {
      const Vec2& middle = b_follows ? a.to : a.from;
      const Vec2& before = b_follows ? a.from : b.from;
      const Vec2& after = b_follows ? b.to : a.to;
      return orientation(before, middle, after) == 0 && (before - middle).dot(after - middle) > 0;
    }
  }
  return segments_touch(a.from, a.to, b.from, b.to);
}

bool both_fixed(const Freedoms& freedom, const BoundaryEdge& a, const BoundaryEdge& b) {
  return is_fixed(freedom, a.chart) && is_fixed(freedom, b.chart);
}

void check_crossings(const std::vector<Chart>& charts, const std::vector<BoundaryEdge>& edges, const BoxTree& tree,
                     const Freedoms& freedom, Validity& validity) {
  for (int i = 0; i < static_cast<int>(edges.size()) && validity.crossings < kMostCrossings; ++i) {
    tree.visit_within(edges[i].box(), kTouching, -1, [&](int j) {
      if (j <= i || both_fixed(freedom, edges[i], edges[j]) || !in_contact(edges[i], edges[j])) return true;
      ++validity.crossings;
      const int a = name_of(charts, edges[i].chart), b = name_of(charts, edges[j].chart);
      note(validity,
           edges[i].chart == edges[j].chart
               ? "the boundary of chart " + std::to_string(a) + " touches or crosses itself near " + place(edges[i].from)
               : "the boundaries of charts " + std::to_string(a) + " and " + std::to_string(b) + " touch or cross near " +
                     place(edges[i].from),
           a);
      return validity.crossings < kMostCrossings;
    });
  }
}

/// How often the boundaries, but for the loop of edges[own] and, where its chart is fixed, all fixed ones, wind around its start,
/// which lies on none of them.
int winding_of_others(const std::vector<BoundaryEdge>& edges, const BoxTree& tree, const Freedoms& freedom, int own,
                      int* chart_around) {
  const Vec2 p = edges[own].from;
  const Box ray{p, {std::numeric_limits<double>::max(), p.y()}};
  int winding = 0;
  std::vector<int> per_chart;
  tree.visit_within(ray, kTouching, -1, [&](int i) {
    const BoundaryEdge& edge = edges[i];
    if ((edge.chart == edges[own].chart && edge.loop == edges[own].loop) || both_fixed(freedom, edge, edges[own])) return true;
    const bool up = edge.from.y() <= p.y() && p.y() < edge.to.y();
    const bool down = edge.to.y() <= p.y() && p.y() < edge.from.y();
    if ((up && orientation(edge.from, edge.to, p) > 0) || (down && orientation(edge.from, edge.to, p) < 0)) {
      winding += up ? 1 : -1;
      if (up) *chart_around = edge.chart;
    }
    return true;
  });
  return winding;
}

/// Exact: whether the simple loop that starts at edges[first] runs counterclockwise, from the turn at its lowest leftmost vertex.
bool counterclockwise(const std::vector<BoundaryEdge>& edges, int first, int end) {
  int lowest = first;
  for (int i = first; i < end; ++i) {
    const Vec2 &p = edges[i].from, &q = edges[lowest].from;
    if (p.x() < q.x() || (p.x() == q.x() && p.y() < q.y())) lowest = i;
  }
  const int before = lowest == first ? end - 1 : lowest - 1;
  return orientation(edges[before].from, edges[lowest].from, edges[lowest].to) > 0;
}

void check_windings(const std::vector<Chart>& charts, const std::vector<BoundaryEdge>& edges, const BoxTree& tree,
                    const Freedoms& freedom, Validity& validity) {
  const int count = static_cast<int>(edges.size());
  for (int first = 0, end = 0; first < count; first = end) {
    while (end < count && edges[end].chart == edges[first].chart && edges[end].loop == edges[first].loop) ++end;
    int around = edges[first].chart;
    const int winding = winding_of_others(edges, tree, freedom, first, &around);
    const bool alone = is_fixed(freedom, edges[first].chart) || counterclockwise(edges, first, end);
    if (winding == (alone ? 0 : 1)) continue;
    const int chart = name_of(charts, edges[first].chart);
    note(validity,
         around == edges[first].chart
             ? "chart " + std::to_string(chart) + " overlaps itself near " + place(edges[first].from)
             : "chart " + std::to_string(chart) + " overlaps chart " + std::to_string(name_of(charts, around)),
         chart);
  }
}

}  // namespace

Validity certify_charts(const std::vector<Chart>& charts, const Freedoms& freedom) {
  Validity validity;
  check_triangles(charts, freedom, validity);
  const std::vector<BoundaryEdge> edges = boundary_edges(charts);
  const BoxTree tree = tree_over(edges);
  check_crossings(charts, edges, tree, freedom, validity);
  if (validity.valid()) check_windings(charts, edges, tree, freedom, validity);
  return validity;
}

}  // namespace atlas_refine
