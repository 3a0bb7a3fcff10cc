// Rotations worth trying for a rigid outline: those that make its bounding box
// small.
#pragma once

#include <vector>

#include "pack/pack_charts.h"

namespace atlas_refine {

/// A rotation about the origin.
struct Turn {
  double cosine = 1;
  double sine = 0;

  Vec2 apply(const Vec2& p) const { return {cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y()}; }
  /// Both as one.
  Turn after(const Turn& first) const {
    return {cosine * first.cosine - sine * first.sine, sine * first.cosine + cosine * first.sine};
  }
  Turn quarter_turned() const { return {-sine, cosine}; }
};

/// Corners of the outline's convex hull, counterclockwise, no three collinear.
std::vector<Vec2> convex_hull(const Outline& outline);

/// Bounding box of the points after the turn.
Box turned_box(const std::vector<Vec2>& points, const Turn& turn);

/// The turns that lay a hull edge on an axis and are local minima of the
/// bounding box' area, smallest box first, at most `count`; one per class of
/// quarter turns. Never empty.
std::vector<Turn> small_box_turns(const std::vector<Vec2>& hull, int count);

/// The turns that lay a hull edge on an axis and whose bounding boxes are the smallest, but for a relative `tolerance` of their
/// areas; at most `count`, one per class of quarter turns. Never empty.
std::vector<Turn> smallest_box_turns(const std::vector<Vec2>& hull, double tolerance, std::size_t count);

/// The turn with the smallest bounding box of the given aspect (width /
/// height), exact; for aspect 0 the smallest bounding box.
Turn best_turn(const std::vector<Vec2>& hull, double aspect);
/// The same among the turns that the outline may get.
Turn best_turn(const Outline& outline, double aspect);

/// The turns of the outline that are worth trying and that it may get, all
/// quarter turns among them: of small_box_turns() at most `count` classes.
std::vector<Turn> turns_to_try(const Outline& outline, int count);

/// For each outline that is longer than a box of that aspect and `area` has sides: turns in which it lies on the diagonal, where
/// a smaller box of the aspect holds it so. Nothing for others, where the aspect is 0, and where more than a few are so long.
std::vector<std::vector<Turn>> turns_aslant(const std::vector<Outline>& outlines, double aspect, double area);

}  // namespace atlas_refine
