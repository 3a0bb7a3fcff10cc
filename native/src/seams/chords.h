// Straight ways through a chart between two points of its border: where few seams part much.
#pragma once

#include <array>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Borders of plane regions: loops of vertices, the region on the left, outer loops and holes.
struct Border {
  std::vector<std::vector<int>> loops;  ///< numbers that chords are told by
  std::vector<std::vector<Vec2>> at;    ///< of each loop's vertices
};

/// A segment inside a region whose ends are vertices of its border; where it is `on_surface`, the shortest way between them
/// there.
struct Chord {
  std::array<int, 2> ends;
  std::array<Vec2, 2> at;
  double cut_off = 0;     ///< area of the smaller of the two parts that it leaves; 0 where it joins two loops
  double neck_ratio = 0;  ///< of a neck: length / root of what it cuts off; small is good
  bool on_surface = false;

  double length() const { return (at[1] - at[0]).norm(); }
};

/// Whether the way from a vertex of a loop to the target begins in the region.
bool leads_inside(const std::vector<Vec2>& loop, int k, const Vec2& target);

/// The necks of the regions: chords that are short for what they cut off, at least `least_part`, best first, none near a better
/// one; at most `most`. Those between two loops count as if they cut off a quarter of the region.
std::vector<Chord> necks(const Border& border, double least_part, int most);

/// The shortest chords to the border from a point inside that is none of its vertices, each at another side of it; at most
/// `most`.
std::vector<Chord> chords_from(const Border& border, int vertex, const Vec2& at, int most);

}  // namespace atlas_refine
