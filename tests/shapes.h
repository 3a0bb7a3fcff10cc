// Generated test atlases: named polygons, random polygons, and the awkward cases, meshed and lifted to a gently curved surface.
//
// Every atlas is built the same way: a UV polygon is triangulated with edges of about `edge_length`, and its 3D positions are
// the UVs lifted to a wavy surface, so that the UVs are not isometric (E_d > 1 for bend > 0). All shapes fit a box of about
// 1 x 1 in UV units. Faces are counterclockwise in the UV plane unless said otherwise. Same arguments, same bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine::shapes {

/// A simple polygon, counterclockwise, with clockwise holes strictly inside it.
struct Polygon {
  std::vector<Vec2> outer;
  std::vector<std::vector<Vec2>> holes;
};

double area(const Polygon& polygon);
/// Turned by `angle_rad` about the origin, scaled, then moved.
Polygon transformed(const Polygon& polygon, double scale, double angle_rad, const Vec2& offset);

Polygon rectangle(double width, double height);                       ///< min corner at the origin
Polygon disk(double radius, int corners = 48);                        ///< centred at the origin
Polygon ring(double inner_radius = 0.25, double outer_radius = 0.5);  ///< annulus centred at the origin
Polygon c_shape();
Polygon s_shape();
Polygon u_shape();
Polygon spiral(double turns = 2.0);  ///< a band that winds `turns` times without touching itself
Polygon comb(int teeth = 6);
Polygon star(int points = 5);
/// Star-shaped about its centre, radius with noise.
Polygon random_star_polygon(std::uint64_t seed, int corners = 24);
/// Any simple polygon: a closed tour through random points without crossings. No two edges that are not neighbours come
/// nearer than 0.04, no angle is below 20 degrees.
Polygon random_polygon(std::uint64_t seed, int corners = 11);

/// One chart: the polygon triangulated and lifted. `bend` is the slope of the surface's waves, 0 = flat (E_d = 1).
Atlas mesh(const Polygon& polygon, double edge_length = 0.05, double bend = 0.5);

/// Several atlases in one, UVs as they are, 3D positions set side by side; nothing is shared between them.
Atlas combine(const std::vector<Atlas>& atlases);

/// The named one-chart shapes above by name: C, S, U, spiral, comb, star, ring.
struct Named {
  std::string name;
  Polygon polygon;
};
std::vector<Named> named_polygons();

// Atlases of several charts.
Atlas two_squares(double distance);              ///< unit squares of two meshes side by side, `distance` apart in u
Atlas squares(int count, double spacing = 0.2);  ///< many charts: a grid of quads of 2 x 2 faces, sides 0.5..1
/// As real atlases of thousands of charts are: four of five are scraps of 2 to 8 triangles, the others blobs, sizes uneven.
Atlas scraps_and_blobs(int count, std::uint64_t seed = 1);
Atlas disk_in_ring();     ///< a ring, and a small disk as a second chart inside its hole
Atlas touching_charts();  ///< two squares that share a whole border line in UV, not in 3D

// Single charts with a twist.
Atlas quad_grid(int columns, int rows);                       ///< faces with 4 corners, lifted
Atlas quad_band(int along, int across, double turns = 0.75);  ///< faces with 4 corners along a part of a ring, lifted
Atlas honeycomb(int columns, int rows);                       ///< faces with 6 corners, lifted
Atlas self_overlapping(double turns = 1.4);   ///< a band wound over itself: every triangle positive, not injective
Atlas mirrored(const Atlas& atlas);           ///< u negated: every face clockwise
Atlas with_flipped_face(const Atlas& atlas);  ///< one inner vertex pulled over its fan: some faces clockwise

}  // namespace atlas_refine::shapes
