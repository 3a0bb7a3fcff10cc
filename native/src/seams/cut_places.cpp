// Necks of the charts that lose most, ranked twice.
#include "seams/cut_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "cut/scale_forecast.h"
#include "geometry/boundary.h"
#include "geometry/plane.h"
#include "seams/edge_ways.h"

namespace atlas_refine {
namespace {

constexpr std::size_t kCharts = 6;         // that lose most: only they are looked at, of many more
constexpr int kNecks = 24;                 // of each chart
constexpr double kAround = 0.75;           // of a cut's length: what is so near it can relax
constexpr std::array kParts = {0.3, 0.6};  // of such a way: the border of a bowl lies flat when it is slit a little
constexpr double kLongWay = 0.1;           // of the border: others are cheap enough as a whole
constexpr int kWays = 2;                   // to each point of high curvature, of the chart that loses most

double lost(const ChartState& state) {
  return std::accumulate(state.losses.begin(), state.losses.end(), 0.0, [](double sum, const Loss& l) { return sum + l.amount; });
}

/// Charts that may be cut, those that lose most first.
std::vector<int> charts_by_loss(const std::vector<ChartState>& states) {
  std::vector<int> out;
  for (std::size_t c = 0; c < states.size(); ++c) {
    if (states[c].cuts) out.push_back(static_cast<int>(c));
  }
  std::stable_sort(out.begin(), out.end(), [&](int a, int b) { return lost(states[a]) > lost(states[b]); });
  out.resize(std::min(out.size(), std::max(kCharts, states.size() / kFewCharts)));
  return out;
}

double length_of(const Border& border) {
  double sum = 0;
  for (const std::vector<Vec2>& loop : border.at) {
    for (std::size_t k = 0; k < loop.size(); ++k) sum += (loop[(k + 1) % loop.size()] - loop[k]).norm();
  }
  return sum;
}

double area_within(const Border& border) {
  double sum = 0;
  for (const std::vector<Vec2>& loop : border.at) sum += 0.5 * doubled_area(loop);
  return sum;
}

double loss_near(const ChartState& state, const Chord& chord) {
  const double reach = kAround * chord.length();
  double sum = 0;
  for (const Loss& loss : state.losses) {
    if (closest_on_segment(loss.at, chord.at[0], chord.at[1]).distance < reach) sum += loss.amount;
  }
  return sum;
}

/// What a hole that does not turn on the surface as in the plane costs the chart around it, as a part of what one costs that is
/// the end of a tube; as of any cone it grows with the square of the angle that is missing.
double part_of_hole(double turn) {
  const double missing = (turn + 2 * std::numbers::pi) / (2 * std::numbers::pi);
  return missing * missing;
}

/// The number of a loop that has the vertex, but for `other`; -1 where none has.
int loop_with(const Border& border, int vertex, int other) {
  for (int l = 0; l < static_cast<int>(border.loops.size()); ++l) {
    const std::vector<int>& loop = border.loops[l];
    if (l != other && std::find(loop.begin(), loop.end(), vertex) != loop.end()) return l;
  }
  return -1;
}

/// By a cut that joins two loops of the border: from a hole to the outside it opens that, two holes become one.
double freed_by(const ChartState& state, const Border& border, const std::vector<double>& turns, const Chord& chord) {
  if (chord.cut_off > 0) return 0;
  const int a = loop_with(border, chord.ends[0], -1), b = loop_with(border, chord.ends[1], a);
  if (a < 0 || b < 0) return 0;
  const bool a_is_hole = doubled_area(border.at[a]) <= 0, b_is_hole = doubled_area(border.at[b]) <= 0;
  double part = (a_is_hole ? part_of_hole(turns[a]) : 0) + (b_is_hole ? part_of_hole(turns[b]) : 0);
  if (a_is_hole && b_is_hole) part -= part_of_hole(turns[a] + turns[b] + 2 * std::numbers::pi);
  return std::clamp(part, 0.0, 1.0) * lost(state);
}

/// Per vertex of the chart: whether it lies on the border, or next to a cut across edges.
std::vector<char> near_border(const ChartState& state, const Border& border) {
  const int count = state.chart->vertex_count();
  const SplitMesh& mesh = state.cuts->mesh();
  std::vector<char> out(count, 0);
  for (const std::vector<int>& loop : border.loops) {
    for (const int v : loop) {
      if (v < 0) continue;  // no vertex yet
      if (v < count) out[v] = 1;
      for (const Side& s : v < count ? std::vector<Side>() : mesh.fan(v)) {
        if (mesh.to(s) < count) out[mesh.to(s)] = 1;
      }
    }
  }
  return out;
}

/// The vertex inside that is nearest to a point; there must be one.
int nearest_inside(const std::vector<Vec2>& uvs, const std::vector<char>& at_border, const Vec2& point) {
  int best = -1;
  for (int v = 0; v < static_cast<int>(at_border.size()); ++v) {
    if (!at_border[v] && (best < 0 || (uvs[v] - point).squaredNorm() < (uvs[best] - point).squaredNorm())) best = v;
  }
  return best;
}

/// Ways from the border to points that would be scaled much, were the chart laid flat as it is cut; then parts of these ways.
/// What a way there saves grows with the square of the scale's logarithm and of the distance, which it costs.
std::vector<CutPlace> ways_to_tips(const ChartState& state, int chart, const Border& border, int most) {
  const std::vector<char> at_border = near_border(state, border);
  const std::vector<double> scales = ScaleForecast(*state.chart).logarithms(at_border);
  const SplitMesh& mesh = state.cuts->mesh();
  std::vector<int> sources;
  for (int v = 0; v < static_cast<int>(at_border.size()); ++v) {
    if (at_border[v]) sources.push_back(v);
  }
  const auto length = [&](const Side& s) { return (mesh.uvs[mesh.to(s)] - mesh.uvs[mesh.from(s)]).norm(); };
  const std::vector<double> away = edge_ways(mesh, sources, length, [](int) { return true; }).cost;
  std::vector<double> worth(scales.size(), 0);
  for (std::size_t v = 0; v < scales.size(); ++v) worth[v] = at_border[v] ? 0 : scales[v] * scales[v] * away[v];
  const std::vector<Vec2>& uvs = mesh.uvs;
  std::vector<CutPlace> out, parts;
  while (static_cast<int>(out.size()) + kWays <= most) {
    const int tip = static_cast<int>(std::max_element(worth.begin(), worth.end()) - worth.begin());
    if (!(worth[tip] > 0)) break;
    for (const Chord& chord : chords_from(border, tip, uvs[tip], kWays)) {
      out.push_back({chart, chord, loss_near(state, chord)});
      if (chord.length() < kLongWay * length_of(border)) continue;
      for (const double part : kParts) {
        Chord shorter = chord;
        shorter.ends[1] = nearest_inside(uvs, at_border, chord.at[0] + part * (chord.at[1] - chord.at[0]));
        shorter.at[1] = uvs[shorter.ends[1]];
        if (shorter.ends[1] != tip) parts.push_back({chart, shorter, loss_near(state, shorter)});
      }
    }
    for (std::size_t v = 0; v < worth.size(); ++v) {
      if ((uvs[v] - uvs[tip]).norm() < away[tip]) worth[v] = 0;
    }
  }
  out.insert(out.end(), parts.begin(), parts.end());
  return out;
}

bool same(const CutPlace& a, const CutPlace& b) { return a.chart == b.chart && a.chord.ends == b.chord.ends; }

}  // namespace

std::vector<CutPlace> cut_places(const std::vector<ChartState>& states, int straight, int tips) {
  std::vector<CutPlace> out, ranked, ways;
  const std::vector<int> charts = charts_by_loss(states);
  for (const int c : charts) {
    const Border border = states[c].cuts->border();
    const bool has_holes = border.loops.size() > 1;
    const std::vector<double> turns = has_holes ? states[c].cuts->turns() : std::vector<double>();
    const auto place = [&](const Chord& chord) {
      return CutPlace{c, chord, loss_near(states[c], chord), freed_by(states[c], border, turns, chord)};
    };
    for (const Chord& chord : has_holes ? states[c].cuts->ways_from_holes() : std::vector<Chord>()) {
      CutPlace way = place(chord);
      if (way.opens_hole() && static_cast<int>(out.size()) < straight) out.push_back(std::move(way));
    }
    for (const Chord& chord : necks(border, kLeastPart * area_within(border), kNecks)) ranked.push_back(place(chord));
    // Of many charts, each with little of what is lost, a few in each.
    const int most = states.size() > kFewCharts ? std::max(kWays, tips / 2) : c == charts.front() ? tips : 0;
    for (CutPlace& way : ways_to_tips(states[c], c, border, most)) ways.push_back(std::move(way));
  }
  std::vector<CutPlace> by_loss = ranked;
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const CutPlace& a, const CutPlace& b) { return a.chord.neck_ratio < b.chord.neck_ratio; });
  std::stable_sort(by_loss.begin(), by_loss.end(), [](const CutPlace& a, const CutPlace& b) {
    return a.released / a.chord.length() > b.released / b.chord.length();
  });
  const auto add = [&](const CutPlace& place) {
    if (std::none_of(out.begin(), out.end(), [&](const CutPlace& other) { return same(other, place); })) out.push_back(place);
  };
  for (std::size_t k = 0; k < ranked.size(); ++k) {
    if (static_cast<int>(out.size()) < straight) add(by_loss[k]);
    if (static_cast<int>(out.size()) < straight) add(ranked[k]);
  }
  for (const CutPlace& way : ways) add(way);
  return out;
}

}  // namespace atlas_refine
