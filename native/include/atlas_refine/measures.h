// What is measured on an atlas, before and after; one meaning for each word everywhere.
#pragma once

#include <string>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Figures of one atlas. Lengths in UV units unless said otherwise. "Gap" is the smallest distance between boundaries.
struct Measures {
  double pe = 0;               ///< packing efficiency: sum of UV triangle areas / area of the UV bounding box
  double pe_fixed_aspect = 0;  ///< the same against the smallest box of the texture's shape; equals pe where the aspect is free
  double box_width = 0;        ///< UV bounding box
  double box_height = 0;
  double unit_square_share = 0;  ///< sum of UV triangle areas: the share of the texture, where the UVs lie in [0, 1]^2
  double boundary_length =
      0;                ///< BL: 3D length of all seams, each once, without natural boundary / diagonal of the 3D bounding box
  int seam_edges = 0;   ///< 3D edges across which the UVs differ, by more than noise
  int chart_count = 0;  ///< CN
  double smallest_chart = 0;       ///< SA: smallest chart's area / total area, on the surface
  int small_charts = 0;            ///< N3: charts under 3 % of the area
  double distortion = 0;           ///< E_d, eq. (9), under the one global scale that minimises it; 1 = isometric
  double distortion_to_input = 0;  ///< E_2: the same energy from the input's UVs to these; 1 on the input itself
  double stretch_99 = 0;           ///< area-weighted 99th percentile of max(s1, 1 / s2) under the same global scale
  double stretch_max = 0;          ///< largest of the same
  double gap_between = 0;          ///< smallest distance between two charts / box diagonal; infinity with one chart
  double gap_within = 0;  ///< smallest distance between two borders of one chart that are far apart along it / box diagonal
};

/// Faces that are not positive under the divisions into triangles that readers use. Exact; a flipped triangle counts in each.
struct Triangulations {
  int fan_flipped = 0;   ///< as a fan from the first corner
  int ears_flipped = 0;  ///< by ear clipping: the outline crosses itself, or is turned over
  int not_convex = 0;    ///< by some division: of a quad by one of its diagonals, a larger polygon is not strictly convex
};

/// Why an atlas is not valid. Empty `problem` means valid.
struct Validity {
  bool valid() const { return problem.empty(); }
  std::string problem;            ///< one line that names the first problem found
  int chart = -1;                 ///< 0-based chart, -1 where none applies
  int face = -1;                  ///< 0-based input face, -1 where none applies
  int flipped_faces = 0;          ///< faces whose UV area is not positive in the sense of their chart
  int mirrored_charts = 0;        ///< charts whose faces are all turned over; counted, and not valid
  int crossings = 0;              ///< pairs of boundary edges that cross or touch
  Triangulations triangulations;  ///< told, and no reason not to be valid, where some division of each face is positive
};

/// Measures an atlas as it is. `box_aspect` is width / height of the texture that [0, 1]^2 stands for, 0 = free: with W:H all
/// lengths are taken with u stretched by W / H; box_width and box_height stay in UV units. `in_texture`: pe_fixed_aspect is what
/// the charts cover of the texture, as with RefineOptions::in_texture.
/// Throws RefineError(BadInput) for arrays that do not fit together or hold NaN, BadOption for an aspect outside [0.01, 100].
Measures measure(const Atlas& atlas, double box_aspect = 0, bool in_texture = false);

/// Exact certificate (Shewchuk-style filtered predicates): every UV triangle strictly positive and no two boundary edges crossing
/// or touching, but where two vertices of a chart are one point, in space and in the UV plane (a pinch), and the faces there stay
/// apart. The charts are those that were meant: UVs at the two sides of an edge, and at a pinch, that differ by noise (up to
/// 1e-4 of the tile, of a smaller atlas' long side, 5 % of the edge) are one, and tested with one value for each vertex: its
/// first corner's, or what turns no face. Charts folded onto each other are tested apart, as refine() takes them. Throws
/// RefineError(BadInput) like `measure`.
Validity validate(const Atlas& atlas);

}  // namespace atlas_refine
