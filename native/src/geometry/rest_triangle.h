// The undeformed shape of a triangle, laid flat.
#pragma once

#include <array>

#include "geometry/chart.h"

namespace atlas_refine {

/// Triangles lower than this fraction of their longest edge count as slivers: their shape in space is the rounding of their
/// file's digits.
inline constexpr double kSliverHeight = 1e-7;

/// The triangle in the plane, p0 at the origin and p1 on the positive x axis. Zero `area` where it is a sliver.
RestTriangle rest_from_space(const Vec3& p0, const Vec3& p1, const Vec3& p2);

/// The triangle with its longest side at the bottom and its height raised to `least_height` of that, where it has less: a shape
/// for slivers. Zero `area` where all corners are one point.
RestTriangle rest_raised(const Vec3& p0, const Vec3& p1, const Vec3& p2, double least_height);

/// The shape of a triangle of the plane, counterclockwise, times `scale`. Zero `area` where it is a sliver or not positive.
RestTriangle rest_from_plane(const Vec2& p0, const Vec2& p1, const Vec2& p2, double scale);

/// The triangle with sides (0, 1), (1, 2), (2, 0) of these lengths; low, where they do not close to one.
RestTriangle rest_from_sides(const std::array<double, 3>& lengths);

/// Of the sides (0, 1), (1, 2), (2, 0).
std::array<double, 3> side_lengths(const RestTriangle& shape);

/// An equilateral triangle of the given area > 0.
RestTriangle rest_equilateral(double area);

}  // namespace atlas_refine
