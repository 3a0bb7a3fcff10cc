// The validity certificate: exact predicates on the values that are stored.
//
// A chart whose triangles are all positive covers each point of the plane as often as its boundary winds around it. So charts
// are embedded, and apart from each other, exactly where (1) every triangle is positive, (2) no two boundary edges touch, and
// (3) the boundaries together wind once around the points just left of every loop. (3) finds what the boundaries alone do not
// show: a chart inside another, and a chart that folds over itself around a branch point.
// At a pinch, where two fans of a chart meet at one vertex of the surface, borders may touch: they could be drawn apart there, as
// long as the fans do not reach into each other.
#include "measure/certificate.h"

#include <limits>
#include <sstream>
#include <string>

#include "geometry/predicates.h"
#include "measure/boundary_edges.h"
#include "support/gathered.h"
#include "support/profile.h"

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

std::vector<int> triangles_not_positive(const Chart& chart) {
  constexpr int kGrain = 4096;
  return gathered<int>(static_cast<int>(chart.triangles.size()), kGrain, [&](int begin, int end, auto& out) {
    for (int t = begin; t < end; ++t) {
      const Triangle& v = chart.triangles[t];
      if (!(orientation(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]) > 0)) out.push_back(t);
    }
  });
}

void check_triangles(const std::vector<Chart>& charts, const Freedoms& freedom, Validity& validity) {
  for (std::size_t k = 0; k < charts.size(); ++k) {
    if (is_fixed(freedom, k)) continue;
    const Chart& chart = charts[k];
    int last_face = -1;
    for (const int t : triangles_not_positive(chart)) {
      const Triangle& v = chart.triangles[t];
      const int face = chart.triangle_faces[t];
      const int sign = orientation(chart.uvs[v[0]], chart.uvs[v[1]], chart.uvs[v[2]]);
      if (face == last_face) continue;
      last_face = face;
      ++validity.flipped_faces;
      const std::string what = sign == 0 ? " has no area in the UV map" : " is flipped in the UV map";
      const int name = name_of(charts, static_cast<int>(k));
      note(validity, "face " + std::to_string(face) + " of chart " + std::to_string(name) + what, name, face);
    }
  }
}

/// The boundaries, and where in space their vertices are.
struct Borders {
  const std::vector<BoundaryEdge> edges;
  const BoxTree tree;
  const std::vector<std::vector<int>>& points;
  const Freedoms& freedom;

  /// Fixed charts may be on each other.
  bool both_fixed(const BoundaryEdge& a, const BoundaryEdge& b) const {
    return is_fixed(freedom, a.chart) && is_fixed(freedom, b.chart);
  }
  /// Whether two vertices of a chart are one point, of the surface and of the plane.
  bool pinched(int chart, int v, const Vec2& at_v, int w, const Vec2& at_w) const {
    return at_v == at_w && !points.empty() && points[chart][v] == points[chart][w];
  }
  bool meet(const BoundaryEdge& a, int v, const Vec2& at_v, int w, const Vec2& at_w) const {
    return v == w || pinched(a.chart, v, at_v, w, at_w);
  }
};

bool fold_onto_each_other(const Vec2& a, const Vec2& middle, const Vec2& b) {
  return orientation(a, middle, b) == 0 && (a - middle).dot(b - middle) > 0;
}

/// Whether two boundary edges share more than the common end that neighbours in a loop have, or that a pinch gives them.
bool in_contact(const Borders& borders, const BoundaryEdge& a, const BoundaryEdge& b) {
  if (a.chart == b.chart) {
    const auto meet = [&](int v, const Vec2& at_v, int w, const Vec2& at_w) { return borders.meet(a, v, at_v, w, at_w); };
    const bool b_follows = meet(a.to_vertex, a.to, b.from_vertex, b.from);
    const bool a_follows = meet(b.to_vertex, b.to, a.from_vertex, a.from);
    const bool same_end = meet(a.to_vertex, a.to, b.to_vertex, b.to);
    const bool same_start = meet(a.from_vertex, a.from, b.from_vertex, b.from);
    if (b_follows + a_follows + same_end + same_start > 1) return true;
    if (b_follows) return fold_onto_each_other(a.from, a.to, b.to);
    if (a_follows) return fold_onto_each_other(b.from, a.from, a.to);
    if (same_end) return fold_onto_each_other(a.from, a.to, b.from);
    if (same_start) return fold_onto_each_other(a.to, a.from, b.to);
  }
  return segments_touch(a.from, a.to, b.from, b.to);
}

/// Whether direction x comes before y going counterclockwise from `start`; all are seen from the point `at`, no two are alike.
bool before(const Vec2& at, const Vec2& start, const Vec2& x, const Vec2& y) {
  const auto half = [&](const Vec2& p) {
    const int turn = orientation(at, start, p);
    return turn > 0 ? 0 : turn < 0 ? 2 : 1;  // straight on lies between the halves
  };
  return half(x) != half(y) ? half(x) < half(y) : orientation(at, x, y) > 0;
}

/// Whether the fans of two boundary vertices at one point reach into each other; each lies left of the edges into and out of it.
bool fans_overlap(const BoundaryEdge& into_a, const BoundaryEdge& out_of_a, const BoundaryEdge& into_b,
                  const BoundaryEdge& out_of_b) {
  const Vec2& at = into_a.to;
  const Vec2 &start = out_of_a.to, &end = into_a.from;
  return !(before(at, start, end, out_of_b.to) && before(at, start, out_of_b.to, into_b.from));
}

/// The edge that follows edges[i] in its loop.
int following(const std::vector<BoundaryEdge>& edges, int i) {
  const auto same_loop = [&](int j) { return edges[j].chart == edges[i].chart && edges[j].loop == edges[i].loop; };
  if (i + 1 < static_cast<int>(edges.size()) && same_loop(i + 1)) return i + 1;
  return i - edges[i].position;
}

bool touch_or_cross(const Borders& borders, int i, int j) {
  const std::vector<BoundaryEdge>& edges = borders.edges;
  const BoundaryEdge &a = edges[i], &b = edges[j];
  if (in_contact(borders, a, b)) return true;
  // A pinch is looked at where both edges run into it.
  if (a.chart != b.chart || a.to_vertex == b.to_vertex || !borders.pinched(a.chart, a.to_vertex, a.to, b.to_vertex, b.to))
    return false;
  return fans_overlap(a, edges[following(edges, i)], b, edges[following(edges, j)]);
}

void check_crossings(const std::vector<Chart>& charts, const Borders& borders, Validity& validity) {
  const std::vector<BoundaryEdge>& edges = borders.edges;
  for (int i = 0; i < static_cast<int>(edges.size()) && validity.crossings < kMostCrossings; ++i) {
    borders.tree.visit_within(edges[i].box(), kTouching, -1, [&](int j) {
      if (j <= i || borders.both_fixed(edges[i], edges[j]) || !touch_or_cross(borders, i, j)) return true;
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

/// How often the boundaries, but for the loop of `own` and, where its chart is fixed, all fixed ones, wind around a point of it
/// just behind its start: where the boundaries do not cross, it lies on none of them, though its start may (a pinch).
int winding_of_others(const Borders& borders, const BoundaryEdge& own, int* chart_around) {
  const Vec2 &p = own.from, &ahead = own.to;
  const Box ray{p, {std::numeric_limits<double>::max(), p.y()}};
  const auto below = [&](const Vec2& q) { return q.y() < p.y() || (q.y() == p.y() && ahead.y() >= p.y()); };
  int winding = 0;
  borders.tree.visit_within(ray, kTouching, -1, [&](int i) {
    const BoundaryEdge& edge = borders.edges[i];
    const bool skipped = (edge.chart == own.chart && edge.loop == own.loop) || borders.both_fixed(edge, own);
    if (skipped || below(edge.from) == below(edge.to)) return true;
    const int up = below(edge.from) ? 1 : -1;
    int side = orientation(edge.from, edge.to, p);
    if (side == 0) side = orientation(edge.from, edge.to, ahead);
    if (side != up) return true;
    winding += up;
    if (up > 0) *chart_around = edge.chart;
    return true;
  });
  return winding;
}

/// Exact: whether the loop that starts at edges[first] runs counterclockwise, from the turn at its lowest leftmost vertex; where
/// it comes there several times (a pinch), one that turns right has the loop's outside behind it.
bool counterclockwise(const std::vector<BoundaryEdge>& edges, int first, int end) {
  int lowest = first;
  for (int i = first; i < end; ++i) {
    const Vec2 &p = edges[i].from, &q = edges[lowest].from;
    if (p.x() < q.x() || (p.x() == q.x() && p.y() < q.y())) lowest = i;
  }
  for (int i = first; i < end; ++i) {
    if (edges[i].from != edges[lowest].from) continue;
    const int before = i == first ? end - 1 : i - 1;
    if (orientation(edges[before].from, edges[i].from, edges[i].to) <= 0) return false;
  }
  return true;
}

void check_windings(const std::vector<Chart>& charts, const Borders& borders, Validity& validity) {
  const std::vector<BoundaryEdge>& edges = borders.edges;
  const int count = static_cast<int>(edges.size());
  for (int first = 0, end = 0; first < count; first = end) {
    while (end < count && edges[end].chart == edges[first].chart && edges[end].loop == edges[first].loop) ++end;
    int around = edges[first].chart;
    const int winding = winding_of_others(borders, edges[first], &around);
    const bool alone = is_fixed(borders.freedom, edges[first].chart) || counterclockwise(edges, first, end);
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

Validity certify_charts(const std::vector<Chart>& charts, const std::vector<std::vector<int>>& points, const Freedoms& freedom) {
  const PhaseScope scope(Phase::Certificate);
  Validity validity;
  check_triangles(charts, freedom, validity);
  std::vector<BoundaryEdge> edges = boundary_edges(charts);
  BoxTree tree = tree_over(edges);
  const Borders borders{std::move(edges), std::move(tree), points, freedom};
  check_crossings(charts, borders, validity);
  if (validity.valid()) check_windings(charts, borders, validity);
  return validity;
}

}  // namespace atlas_refine
