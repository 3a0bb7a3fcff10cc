// What one call of refine() is asked for. Defaults are what an unattended run should use.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "atlas_refine/atlas.h"

namespace atlas_refine {

/// Where new seams may come from. None: charts bend inside a shrinking box (the squeeze), no seam is added. Rectangles: the
/// paper's road; charts become axis-aligned and are cut into rectangles along motorcycle trails (sections 3.1 and 3.2). Needed:
/// charts are squeezed, and cut where their distortion is above max_distortion or max_stretch or, without these, where a cut
/// saves what it costs.
enum class Seams { None, Needed, Rectangles };

/// The shapes that the objective asks triangles to keep (section 3.4, "Distortion type"): the surface's, or those of the input's
/// UVs. Only what is minimised changes: Measures::distortion and max_distortion are E_d on the surface either way.
enum class Reference { Surface, Input };

/// Which relative scale the charts get. Equal: one texel density for the whole surface, as eq. (9) measures E_d.
/// Keep: the objective asks each chart to keep the scale it has in the input. Charts that bend may change it all the same; a
/// warning names those whose texel density changed by more than 10 %. A bound that only charts of more than 1.5 times the density
/// of the others would hold (2 % of what all cover, and more, being theirs beyond that) is not reached.
enum class Density { Equal, Keep };

/// How cuts run. Split: faces are divided where the cut crosses them. Edges: only edges of the input's faces become seams, the
/// connectivity stays exactly (section 4.1, Fig. 16).
enum class Cut { Split, Edges };

/// Charts that lie on each other on purpose (the same or the mirrored shape, UVs equal within 1e-4 of the UV box). Keep: one of
/// them is refined, the others follow it onto the same place, and PE counts their area once. Separate: each gets its own place.
enum class Stacks { Keep, Separate };

/// Charts whose UVs are all on a point or a line (palette swatches, unused UVs). Leave: they stay as they are, outside the atlas.
/// Embed: they get UVs with area.
enum class Collapsed { Leave, Embed };

/// Which turns a chart that is moved without being bent may get.
enum class Rotate { Any, QuarterTurns, None };

/// How many cuts Seams::Needed tries: the more, the fewer seams, and the more time.
enum class Effort { Fast, Normal, Best };

/// The number format the caller will store; the certificate is made on values rounded to it.
enum class Stored { Double, Float32 };

/// The guaranteed smallest distance between two charts.
struct Gap {
  enum class Unit { BoxDiagonal, LongSide };
  double value = 0.0025;          ///< fraction of the unit, in [0, 0.1]
  Unit unit = Unit::BoxDiagonal;  ///< the paper's padding unit; LongSide fits "N texels of a texture of S": N / S

  /// Absolute length for a box of these sides.
  double length(const Vec2& box) const { return value * (unit == Unit::BoxDiagonal ? box.norm() : box.maxCoeff()); }
};

/// What only Seams::Rectangles reads.
struct RectangleOptions {
  double sigma = 0.004;  ///< eq. (3): width of the boundary smoothing / length of the chart's boundary, in (0, 0.1]
  int candidates = 500;  ///< layouts that are packed and scored, N_motor of section 3.2, in [1, 1000000]
  double omega = 0.1;    ///< eq. (11): what boundary length costs against PE, in [0, 1]
  /// Stop once the objective is back at the input's, as the paper does; else go on until the bound stops it.
  bool until_input = false;
};

struct RefineOptions {
  double pe_bound = 0.80;  ///< in (0, 1); reached, or the call throws BoundNotReached unless best_effort
  Seams seams = Seams::None;
  double box_aspect = 0;  ///< width / height of the texture that [0, 1]^2 stands for, in [0.01, 100]; 0 = a free box
  /// The box is the texture itself, square where the aspect is free, in the input too: PE is what charts cover of it, an atlas
  /// that lies elsewhere does not hold the bound, and a gap that is given is kept to the texture's border as well.
  bool in_texture = false;
  /// Hard where given. Else automatic: the largest of 0.0025 of the diagonal and smaller ones, each 0.6 of the one before, with
  /// which the bound is reached without much distortion: the objective rises by at most 2 % on the way; where it rises by more,
  /// the next one is kept if it spares a quarter of that (charts that are cut: with which the rectangles pack to the bound). A
  /// warning says why larger ones were given up. An atlas that is left as it is keeps its own.
  std::optional<Gap> gap;
  /// Largest E_d allowed, >= 1; above it the call throws, with best_effort too, but with Seams::Needed.
  std::optional<double> max_distortion;
  /// Largest Measures::stretch_99 allowed, >= 1, in the same way: 99 % of the surface may be stretched or shrunk by so much. The
  /// objective stays E_d, whose optimum need not have the least stretch: where that exceeds this, charts climb only as far as it
  /// allows.
  std::optional<double> max_stretch;
  /// With Seams::Needed: how much boundary the cuts may add, as a fraction of that of all charts, on the surface; both sides of a
  /// cut count.
  std::optional<double> max_boundary_growth;
  /// With Seams::Needed and without max_distortion or max_stretch: what boundary growth costs in E_d. A cut is made where it
  /// saves more. Charts with less boundary than a flat disk of their area count as if they had that disk's.
  double seam_cost = 0.1;
  Effort effort = Effort::Normal;
  /// With Seams::Needed: look for all outcomes that are worth a choice (CutReport::trade_off, all squeezed to the end), not only
  /// for the one that is asked for; takes several times as long.
  bool trade_off = false;
  std::optional<int> point;  ///< with trade_off: which of them is wanted, whatever the limits; the last where there are fewer
  /// Go on to the least of the objective under the bound where less would already hold it. Rectangles do so anyway, unless
  /// until_input, or in a thousand pieces and more.
  bool relax = false;
  /// Where the bound is not reached return the best valid atlas within max_distortion and max_stretch, do not throw: PE against
  /// what it costs; with Seams::Needed also where one of these is missed, the least distorted one.
  bool best_effort = false;
  Density density = Density::Equal;
  /// The size of the result, as sqrt(UV area / surface area), UV units (of the texture's height) per model unit. A free box may
  /// reach beyond [0, 1]^2 then; 0 = its longer side is 1. With in_texture charts cover of the texture what that size takes, if
  /// that is no more than pe_bound, and bend only as far as that asks; else they fill it as without. Not in a box with charts
  /// that are locked, nor in one of an aspect that is no texture.
  double uv_density = 0;
  Stored stored = Stored::Double;
  RectangleOptions rectangles;
  Reference reference = Reference::Surface;
  /// One weight > 0 per face for its part in the objective (section 4, "Local control"); empty = all 1. Only ratios count.
  std::vector<double> importance;

  /// Of all cuts: rectangles, holes, closed charts. Along edges they like those that bend and those that other parts of the mesh
  /// hide, each down to half of its length's price.
  Cut cut = Cut::Split;
  /// Charts without a boundary, or with a handle, may be opened along edges where seams are None too: they cannot be flat
  /// otherwise, and are left as they are, by name.
  bool open_closed = false;
  Stacks stacks = Stacks::Keep;
  /// One number per face, or empty. Charts of different ones that lie on each other are no stack: they show different textures.
  std::vector<int> stack_groups;
  Collapsed collapsed = Collapsed::Leave;
  Rotate rotate = Rotate::Any;
  bool align_axes = false;   ///< a moved chart whose longest border runs straight is turned so that it lies on an axis
  bool triangulate = false;  ///< of cut faces: triangles throughout, no larger polygons

  /// One number >= 0 per face: the atlas that the face belongs to; faces of different numbers never share a chart, and each
  /// number gets a box of its own. Empty = one atlas.
  std::vector<int> groups;
  std::vector<std::string> group_names;  ///< entry g: what messages call group g; may be shorter
  /// Entry g: the lower left corner of the box of group g; (0, 0) for groups beyond its end.
  std::vector<Vec2> group_origins;
  /// Entry g: width / height of the texture of group g, in [0.01, 100]; `box_aspect` for groups beyond its end.
  std::vector<double> group_aspects;
  /// Entry g: the value of `gap` for group g, whose texture may have another size in pixels; needs `gap`.
  std::vector<double> group_gaps;
  /// Entry g: `uv_density` for group g, where that is given; 0 for none, as where charts are locked.
  std::vector<double> group_densities;
  /// One flag per face, or empty. A chart with a face that is set is only moved: its UVs stay the same shape, to rounding, up to
  /// the scale that `density` gives it.
  std::vector<char> keep_shape;
  /// One flag per face, or empty. A chart with a face that is set keeps its UVs, bit for bit; all others go around it. The box is
  /// then [0, 1]^2 (of the texture's shape).
  std::vector<char> locked;
  /// Edges, as pairs of vertices, that no cut and no opening of a closed chart runs along; Cut::Split may cross some, or run
  /// along them, which is told.
  std::vector<std::array<int, 2>> no_seam;
  /// Edges that cuts along edges, and openings, run along for a tenth of their length's price.
  std::vector<std::array<int, 2>> prefer_seam;

  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = as many as the machine has; the result does not depend on it
};

}  // namespace atlas_refine
