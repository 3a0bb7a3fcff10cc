// Walks through triangles, shortest paths along edges, and what they leave.
#include "seams/chart_cuts.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/boundary.h"
#include "geometry/plane.h"
#include "seams/edge_ways.h"
#include "support/disjoint_sets.h"

namespace atlas_refine {
namespace {

// Of an edge: a cut that crosses it nearer to an end runs through that, where that is no farther aside than this part of the
// length of the cut.
constexpr double kSnap = 0.15;
constexpr double kLeastRun = 0.7;   // of its length a cut runs at least before the border ends it
constexpr double kCorridor = 0.15;  // of the chord's length: at this distance from it edges count double
constexpr double kReach = 0.5;      // farther away no path runs

// Long border edges have places where cuts may end, between parts of so much of the side of a square with the chart's area; the
// number of parts is a multiple of four, so that halves and quarters are among them.
constexpr double kPart = 0.25;
constexpr int kMostParts = 64;

double distance_to(const Chord& chord, const Vec2& at) { return closest_on_segment(at, chord.at[0], chord.at[1]).distance; }

}  // namespace

ChartCuts::ChartCuts(const Piece& piece, const Chart& chart, const SidePrices& prices, Cut cut)
    : chart_(chart), prices_(prices), cut_(cut), mesh_(mesh_of(piece)), on_border_(boundary_flags(piece.mesh)) {
  if (cut_ == Cut::Split) find_places();
}

void ChartCuts::find_places() {
  const double side = side_of_square(mesh_);
  for (const auto& loop : mesh_.boundary_loops()) {
    for (const Side& s : loop) {
      const int from = mesh_.from(s), to = mesh_.to(s);
      const Vec2 a = mesh_.uvs[from], b = mesh_.uvs[to];
      const double length = (b - a).norm();
      if (!(length > kLongEdge * side)) continue;
      const double wanted = std::min<double>(kMostParts, length / (kPart * side));
      const int parts = 4 * static_cast<int>(std::ceil(wanted / 4));
      for (int k = 1; k < parts; ++k) {
        const double along = static_cast<double>(k) / parts;
        places_.push_back({from, to, along, a + along * (b - a)});
      }
    }
  }
}

/// Where a cut before it was left out the border may be another.
bool ChartCuts::is_known(int number, const Vec2& at) const {
  if (number < 0) return ~number < static_cast<int>(places_.size()) && places_[~number].at == at;
  return number < mesh_.vertex_count() && mesh_.uvs[number] == at;
}

/// The vertex there, put there if need be.
int ChartCuts::vertex_at(int number) {
  if (number >= 0) return number;
  Place& place = places_[~number];
  if (place.vertex >= 0) return place.vertex;
  int before = place.from, after = place.to;
  double start = 0, end = 1;
  for (const Place& other : places_) {
    if (other.vertex < 0 || other.from != place.from || other.to != place.to) continue;
    if (other.along < place.along && other.along > start) before = other.vertex, start = other.along;
    if (other.along > place.along && other.along < end) after = other.vertex, end = other.along;
  }
  place.vertex = mesh_.split(mesh_.find_side(before, after), (place.along - start) / (end - start), place.at);
  on_border_.resize(mesh_.vertex_count(), 0);
  on_border_[place.vertex] = 1;
  return place.vertex;
}

bool ChartCuts::add(const Chord& chord) {
  if (!is_known(chord.ends[0], chord.at[0]) || !is_known(chord.ends[1], chord.at[1])) return false;
  const SplitMesh mesh = mesh_;
  const std::vector<Place> places = places_;
  Chord own = chord;
  for (int& end : own.ends) end = vertex_at(end);
  if (cut_between(own)) return true;
  mesh_ = mesh;
  places_ = places;
  on_border_.resize(mesh_.vertex_count());
  return false;
}

/// Between vertices.
bool ChartCuts::cut_between(const Chord& chord) {
  if (!on_border_[chord.ends[0]]) return false;
  const std::vector<int> path = cut_ == Cut::Split && !chord.on_surface ? straight(chord) : along_edges(chord);
  on_border_.resize(mesh_.vertex_count(), 0);
  if (path.size() < 2) return false;
  for (const int v : path) on_border_[v] = 1;
  paths_.push_back(path);
  return true;
}

/// The next vertex on the straight way from one to the target, where a triangle may be divided for it; empty where it leads out.
std::vector<int> ChartCuts::crossing(int vertex, const Vec2& target, int end, double most_aside) {
  const Vec2 at = mesh_.uvs[vertex], way = target - at;
  for (const Side& s : mesh_.fan(vertex)) {
    const int p = mesh_.to(s), q = mesh_.opposite(s);
    if (p == end || q == end) return {end};
    const Vec2 to_p = mesh_.uvs[p] - at, to_q = mesh_.uvs[q] - at;
    const double right = cross(to_p, way), left = cross(way, to_q);
    if (right < 0 || left < 0 || right + left <= 0) continue;
    const double along = right / (right + left);
    const Vec2 meeting = (1 - along) * mesh_.uvs[p] + along * mesh_.uvs[q];
    if ((meeting - at).dot(way) <= 0) continue;
    const auto may_snap = [&](const Vec2& to) { return to.dot(way) > 0 && std::abs(cross(to, way)) < most_aside * way.norm(); };
    if (along < kSnap && may_snap(to_p)) return {p};
    if (along > 1 - kSnap && may_snap(to_q)) return {q};
    const Side across{s.triangle, (s.side + 1) % 3};
    if (mesh_.is_boundary(across) || is_cut(p, q)) return {};
    return {mesh_.split(across, along, meeting)};
  }
  return {};
}

/// Whether a cut runs from one vertex to the other.
bool ChartCuts::is_cut(int p, int q) const {
  if (p >= static_cast<int>(on_border_.size()) || q >= static_cast<int>(on_border_.size())) return false;
  if (!on_border_[p] || !on_border_[q]) return false;
  return std::any_of(paths_.begin(), paths_.end(), [&](const std::vector<int>& path) {
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      if ((path[k] == p && path[k + 1] == q) || (path[k] == q && path[k + 1] == p)) return true;
    }
    return false;
  });
}

std::vector<int> ChartCuts::straight(const Chord& chord) {
  const int end = chord.ends[1];
  std::vector<int> path = {chord.ends[0]};
  const int most = mesh_.triangle_count();
  while (path.back() != end) {
    const std::vector<int> next = crossing(path.back(), chord.at[1], end, kSnap * chord.length());
    if (next.empty() || static_cast<int>(path.size()) > most) return {};
    const Side side = mesh_.find_side(path.back(), next.front());
    if (side.triangle < 0 || mesh_.is_boundary(side)) return {};
    path.push_back(next.front());
    // Snapped to the border: that is as good an end.
    const bool is_old = next.front() < static_cast<int>(on_border_.size());
    if (next.front() != end && is_old && on_border_[next.front()]) {
      const Vec2& at = mesh_.uvs[next.front()];
      return (at - chord.at[0]).norm() > kLeastRun * chord.length() ? path : std::vector<int>();
    }
  }
  return path;
}

std::vector<int> ChartCuts::along_edges(const Chord& chord) const {
  const double width = kCorridor * chord.length(), reach = kReach * chord.length();
  const auto price = [&](const Side& s) {
    if (chord.on_surface) return price_on_surface(s);
    const double away = distance_to(chord, mesh_.uvs[mesh_.to(s)]);
    return away > reach ? kNoSeam : price_on_surface(s) * (1 + away * away / (width * width));
  };
  const auto inside = [&](int v) { return !on_border_[v]; };
  const EdgeWays ways = edge_ways(mesh_, {chord.ends[0]}, price, inside, chord.ends[1]);
  std::vector<int> path;
  if (ways.from[chord.ends[1]] < 0) return path;
  for (int v = chord.ends[1]; v >= 0; v = ways.from[v]) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<Side> ChartCuts::cut_sides() const {
  std::vector<Side> out;
  for (const std::vector<int>& path : paths_) {
    for (std::size_t k = 0; k + 1 < path.size(); ++k) out.push_back(mesh_.find_side(path[k], path[k + 1]));
  }
  return out;
}

/// Numbers of the places where no cut ends yet, by the vertices before and after them on the border.
std::map<std::pair<int, int>, std::vector<int>> ChartCuts::free_places() const {
  std::map<std::pair<int, int>, std::vector<int>> out;
  std::vector<int> free;
  int before = -1;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& place = places_[k];
    if (k == 0 || !on_one_edge(places_[k - 1], place)) before = place.from;
    if (place.vertex < 0) free.push_back(~static_cast<int>(k));
    const bool is_last = k + 1 == places_.size() || !on_one_edge(place, places_[k + 1]);
    if (place.vertex >= 0) out[{std::exchange(before, place.vertex), place.vertex}] = std::exchange(free, {});
    if (is_last) out[{before, place.to}] = std::exchange(free, {});
  }
  return out;
}

Border ChartCuts::border() const {
  SplitMesh opened = mesh_;
  const std::vector<int> copies = opened.cut(cut_sides());
  const auto original = [&](int v) { return v < mesh_.vertex_count() ? v : copies[v - mesh_.vertex_count()]; };
  std::map<int, int> number_of;  // of vertices at places
  for (std::size_t k = 0; k < places_.size(); ++k) number_of[places_[k].vertex] = ~static_cast<int>(k);
  const auto free = free_places();
  Border out;
  for (const std::vector<int>& loop : opened.vertex_loops()) {
    std::vector<int>& numbers = out.loops.emplace_back();
    std::vector<Vec2>& at = out.at.emplace_back();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int v = original(loop[k]), next = original(loop[(k + 1) % loop.size()]);
      const auto known = number_of.find(v);
      numbers.push_back(known == number_of.end() ? v : known->second);
      at.push_back(mesh_.uvs[v]);
      const auto between = free.find({v, next});
      if (between == free.end()) continue;
      for (const int number : between->second) {
        numbers.push_back(number);
        at.push_back(places_[~number].at);
      }
    }
  }
  return out;
}

std::vector<double> ChartCuts::turns() const {
  SplitMesh opened = mesh_;
  opened.cut(cut_sides());
  const auto angle_at = [&](const Side& s) {
    const Triangle& t = opened.triangles[s.triangle];
    const RestTriangle rest =
        rest_of_part(chart_, opened.sources[s.triangle], {opened.supports[t[0]], opened.supports[t[1]], opened.supports[t[2]]});
    if (!(rest.area > 0)) return 0.0;
    const Mat2 sides = rest.inverse_edges.inverse();
    const std::array<Vec2, 3> corners = {Vec2(0, 0), sides.col(0), sides.col(1)};
    const Vec2 one = corners[(s.side + 1) % 3] - corners[s.side], other = corners[(s.side + 2) % 3] - corners[s.side];
    return std::atan2(std::abs(cross(one, other)), one.dot(other));
  };
  std::vector<double> out;
  for (const std::vector<int>& loop : opened.vertex_loops()) {
    double& turn = out.emplace_back(static_cast<double>(loop.size()) * std::numbers::pi);
    for (const int v : loop) {
      for (const Side& s : opened.fan(v)) turn -= angle_at(s);
    }
  }
  return out;
}

std::vector<Chord> ChartCuts::ways_from_holes() const {
  std::vector<Chord> out;
  if (cut_ == Cut::Split) return out;
  const Border border = this->border();
  const auto inside = [&](int v) { return !on_border_[v]; };
  for (std::size_t l = 0; l < border.loops.size(); ++l) {
    if (doubled_area(border.at[l]) > 0) continue;
    const EdgeWays ways = edge_ways(
        mesh_, border.loops[l], [&](const Side& s) { return price_on_surface(s); }, inside);
    int end = -1;
    for (std::size_t other = 0; other < border.loops.size(); ++other) {
      for (const int v : border.loops[other]) {
        if (other != l && ways.from[v] >= 0 && (end < 0 || ways.cost[v] < ways.cost[end])) end = v;
      }
    }
    if (end < 0) continue;
    int start = end;
    while (ways.from[start] >= 0) start = ways.from[start];
    out.push_back({.ends = {start, end}, .at = {mesh_.uvs[start], mesh_.uvs[end]}, .on_surface = true});
  }
  return out;
}

Support ChartCuts::support_of(int number) const {
  if (number >= 0) return mesh_.supports[number];
  const Place& place = places_[~number];
  return between(mesh_.supports[place.from], mesh_.supports[place.to], place.along);
}

bool ChartCuts::divides_border() const {
  return std::any_of(places_.begin(), places_.end(), [](const Place& place) { return place.vertex >= 0; });
}

double ChartCuts::length_on_surface(const Side& side) const {
  const int source = mesh_.sources[side.triangle];
  const Triangle& triangle = chart_.triangles[source];
  const Vec3 way = weights_on(mesh_.supports[mesh_.to(side)], triangle) - weights_on(mesh_.supports[mesh_.from(side)], triangle);
  return (chart_.surface[source].inverse_edges.inverse() * Vec2(way[1], way[2])).norm();
}

/// Of a seam there; infinite where there cannot be one.
double ChartCuts::price_on_surface(const Side& side) const {
  if (mesh_.is_boundary(side)) return kNoSeam;
  return (prices_.empty() ? 1 : prices_[side.triangle][side.side]) * length_on_surface(side);
}

double ChartCuts::length() const {
  double sum = 0;
  for (const Side& s : cut_sides()) sum += length_on_surface(s);
  return sum;
}

double ChartCuts::cost() const {
  double sum = 0;
  for (const Side& s : cut_sides()) sum += price_on_surface(s);
  return sum;
}

double ChartCuts::smallest_part() const {
  std::vector<std::array<char, 3>> is_cut(mesh_.triangle_count(), {0, 0, 0});
  for (const Side& s : cut_sides()) {
    const Side twin = mesh_.twin(s);
    is_cut[s.triangle][s.side] = is_cut[twin.triangle][twin.side] = 1;
  }
  DisjointSets parts(mesh_.triangle_count());
  std::vector<double> area(mesh_.triangle_count(), 0);
  for (int t = 0; t < mesh_.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (!is_cut[t][k] && mesh_.neighbours[t][k] >= 0) parts.unite(t, mesh_.neighbours[t][k]);
    }
  }
  for (int t = 0; t < mesh_.triangle_count(); ++t) {
    const std::array<Support, 3> corners = {mesh_.supports[mesh_.triangles[t][0]], mesh_.supports[mesh_.triangles[t][1]],
                                            mesh_.supports[mesh_.triangles[t][2]]};
    area[parts.find(t)] += rest_of_part(chart_, mesh_.sources[t], corners).area;
  }
  double least = std::numeric_limits<double>::infinity();
  for (int t = 0; t < mesh_.triangle_count(); ++t) {
    if (parts.find(t) == t) least = std::min(least, area[t]);
  }
  return least;
}

}  // namespace atlas_refine
