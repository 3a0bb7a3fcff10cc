// When linear motion in the plane makes a triangle degenerate or a point meet an edge: exact roots of quadratics.
#pragma once

#include "geometry/chart.h"

namespace atlas_refine {

/// A point and its displacement over one step.
struct Moving {
  Vec2 position;
  Vec2 displacement;
};

/// Smallest positive root of a t^2 + b t + c, infinity where there is none.
double smallest_positive_root(double a, double b, double c);

/// Smallest t > 0 at which the triangle's area vanishes, infinity where it never does. The area at t = 0 must be positive.
double flip_time(const Moving& p0, const Moving& p1, const Moving& p2);

/// Smallest t in (0, limit] at which the point lies on the edge (end points included, with a relative tolerance of 1e-7 on the
/// edge's parameter); infinity where it does not.
double hit_time(const Moving& point, const Moving& edge_start, const Moving& edge_end, double limit);

}  // namespace atlas_refine
