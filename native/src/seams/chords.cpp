// Stations along the borders, all pairs of them, those first that are short for what they cut off.
#include "seams/chords.h"

#include <algorithm>
#include <cmath>

#include "geometry/plane.h"
#include "geometry/predicates.h"

namespace atlas_refine {

bool leads_inside(const std::vector<Vec2>& loop, int k, const Vec2& target) {
  const int n = static_cast<int>(loop.size());
  const Vec2 &before = loop[(k + n - 1) % n], &at = loop[k], &after = loop[(k + 1) % n];
  const bool left_of_after = orientation(at, after, target) > 0, left_of_before = orientation(before, at, target) > 0;
  return orientation(before, at, after) > 0 ? left_of_after && left_of_before : left_of_after || left_of_before;
}

namespace {

constexpr int kStations = 128;        // on all loops together
constexpr double kLongest = 1.5;      // of the root of what a chord cuts off: longer ones are no necks
constexpr double kJoinedPart = 0.25;  // of the region: what a chord between two loops counts as
constexpr double kNear = 0.04;        // of all borders' length: chords whose ends are nearer along them are one neck

/// A vertex of the border that chords may end at.
struct Station {
  int loop, index;
  double arc;  ///< on the loop, from its first vertex
};

/// Lengths and areas along one loop, up to each vertex.
struct Loop {
  const std::vector<Vec2>& at;
  std::vector<double> arc, area;

  explicit Loop(const std::vector<Vec2>& points) : at(points), arc(1, 0), area(1, 0) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      const Vec2 &a = at[k], &b = at[(k + 1) % at.size()];
      arc.push_back(arc.back() + (b - a).norm());
      area.push_back(area.back() + 0.5 * cross(a, b));
    }
  }
  double length() const { return arc.back(); }
  double whole() const { return area.back(); }
  double along(int from, int to) const {
    const double way = std::abs(arc[to] - arc[from]);
    return std::min(way, length() - way);
  }
  /// What the chord has on the loop's way from one vertex to a later one.
  double part(int from, int to) const { return area[to] - area[from] + 0.5 * cross(at[to], at[from]); }
  /// How far the border turns away from the region at a vertex; > 0 where that is concave there.
  double concavity(int k) const {
    const int n = static_cast<int>(at.size());
    const Vec2 in = at[k] - at[(k + n - 1) % n], out = at[(k + 1) % n] - at[k];
    return -std::atan2(cross(in, out), in.dot(out));
  }
};

/// One in each stretch of the border, where it is most concave.
std::vector<Station> stations_on(const std::vector<Loop>& loops, double spacing) {
  std::vector<Station> out;
  for (int l = 0; l < static_cast<int>(loops.size()); ++l) {
    const Loop& loop = loops[l];
    int best = -1, stretch = 0;
    for (int k = 0; k < static_cast<int>(loop.at.size()); ++k) {
      const int own = static_cast<int>(loop.arc[k] / spacing);
      if (own != stretch && best >= 0) {
        out.push_back({l, best, loop.arc[best]});
        best = -1;
      }
      stretch = own;
      if (best < 0 || loop.concavity(k) > loop.concavity(best)) best = k;
    }
    if (best >= 0) out.push_back({l, best, loop.arc[best]});
  }
  return out;
}

/// No border is met between the ends. Borders that end at the ends' places do not count.
bool is_free(const Border& border, const Vec2& a, const Vec2& b) {
  const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
  for (const std::vector<Vec2>& loop : border.at) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 &p = loop[k], &q = loop[(k + 1) % loop.size()];
      if ((p.cwiseMin(q).array() > high.array()).any() || (p.cwiseMax(q).array() < low.array()).any()) continue;
      if (p == a || p == b || q == a || q == b) continue;
      if (segments_touch(a, b, p, q)) return false;
    }
  }
  return true;
}

struct Pair {
  Station a, b;
  double cut_off, neck_ratio;
};

class NeckSearch {
 public:
  NeckSearch(const Border& border, double least_part) : border_(border), least_part_(least_part) {
    for (const std::vector<Vec2>& loop : border.at) {
      loops_.emplace_back(loop);
      length_ += loops_.back().length();
      area_ += loops_.back().whole();
    }
  }

  std::vector<Chord> run(int most) {
    const std::vector<Station> stations = stations_on(loops_, length_ / kStations);
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < stations.size(); ++a) {
      for (std::size_t b = a + 1; b < stations.size(); ++b) consider(stations[a], stations[b], pairs);
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.neck_ratio < b.neck_ratio; });
    std::vector<Pair> kept;
    for (const Pair& pair : pairs) {
      if (static_cast<int>(kept.size()) == most) break;
      if (!near_one_of(kept, pair) && is_inside(pair)) kept.push_back(pair);
    }
    std::vector<Chord> out;
    for (const Pair& pair : kept)
      out.push_back({.ends = {number(pair.a), number(pair.b)},
                     .at = {place(pair.a), place(pair.b)},
                     .cut_off = pair.cut_off,
                     .neck_ratio = pair.neck_ratio});
    return out;
  }

 private:
  const Vec2& place(const Station& s) const { return border_.at[s.loop][s.index]; }
  int number(const Station& s) const { return border_.loops[s.loop][s.index]; }

  void consider(const Station& a, const Station& b, std::vector<Pair>& pairs) const {
    const double length = (place(b) - place(a)).norm();
    if (length == 0) return;
    double part = kJoinedPart * area_, cut_off = 0;
    if (a.loop == b.loop) {
      const Loop& loop = loops_[a.loop];
      part = loop.part(a.index, b.index);
      part = cut_off = std::min(part, loop.whole() - part);
      if (loop.whole() <= 0 || part < least_part_) return;
    }
    const double neck_ratio = length / std::sqrt(part);
    if (neck_ratio < kLongest) pairs.push_back({a, b, cut_off, neck_ratio});
  }

  bool is_inside(const Pair& pair) const {
    const Vec2 &a = place(pair.a), &b = place(pair.b);
    return leads_inside(border_.at[pair.a.loop], pair.a.index, b) && leads_inside(border_.at[pair.b.loop], pair.b.index, a) &&
           is_free(border_, a, b);
  }

  bool near(const Station& a, const Station& b) const {
    return a.loop == b.loop && loops_[a.loop].along(a.index, b.index) < kNear * length_;
  }
  bool near_one_of(const std::vector<Pair>& kept, const Pair& pair) const {
    return std::any_of(kept.begin(), kept.end(), [&](const Pair& other) {
      return (near(pair.a, other.a) && near(pair.b, other.b)) || (near(pair.a, other.b) && near(pair.b, other.a));
    });
  }

  const Border& border_;
  double least_part_, length_ = 0, area_ = 0;
  std::vector<Loop> loops_;
};

}  // namespace

std::vector<Chord> necks(const Border& border, double least_part, int most) { return NeckSearch(border, least_part).run(most); }

std::vector<Chord> chords_from(const Border& border, int vertex, const Vec2& at, int most) {
  std::vector<Loop> loops(border.at.begin(), border.at.end());
  double length = 0;
  for (const Loop& loop : loops) length += loop.length();
  std::vector<Station> stations = stations_on(loops, length / kStations);
  const auto place = [&](const Station& s) -> const Vec2& { return border.at[s.loop][s.index]; };
  std::stable_sort(stations.begin(), stations.end(),
                   [&](const Station& a, const Station& b) { return (place(a) - at).norm() < (place(b) - at).norm(); });
  std::vector<Chord> out;
  for (const Station& s : stations) {
    if (static_cast<int>(out.size()) == most) break;
    const Vec2 way = place(s) - at;
    const bool beside = std::any_of(
        out.begin(), out.end(), [&](const Chord& other) { return way.normalized().dot((other.at[0] - at).normalized()) > 0.5; });
    if (beside || !leads_inside(border.at[s.loop], s.index, at) || !is_free(border, at, place(s))) continue;
    out.push_back({.ends = {border.loops[s.loop][s.index], vertex}, .at = {place(s), at}});
  }
  return out;
}

}  // namespace atlas_refine
